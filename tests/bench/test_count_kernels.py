#!/usr/bin/env python3
"""test_count_kernels.py BENCH: what the counter of double operations and bytes makes of instructions and profiles."""
import sys
import tempfile
import unittest
from pathlib import Path

BENCH = Path(sys.argv.pop(1))
sys.path.insert(0, str(BENCH / "scaling"))
import count_kernels  # noqa: E402
from count_kernels import Work, bytes_of, flops_of, parts  # noqa: E402


class Instructions(unittest.TestCase):
    def test_double_operations(self) -> None:
        for name, operands, flops in [("vaddpd", "%ymm1,%ymm2,%ymm3", 4), ("vmulsd", "0x8(%rax),%xmm1,%xmm2", 1),
                                      ("vdivpd", "%xmm1,%xmm2,%xmm3", 2), ("vsqrtsd", "%xmm1,%xmm1,%xmm1", 1),
                                      ("vfmadd213pd", "%ymm1,%ymm2,%ymm3", 8), ("addsd", "%xmm1,%xmm0", 1),
                                      ("vminpd", "%ymm1,%ymm2,%ymm3", 0), ("vaddps", "%ymm1,%ymm2,%ymm3", 0),
                                      ("addq", "$0x1,(%rax)", 0), ("vmovapd", "%ymm1,(%rax)", 0)]:
            self.assertEqual(flops_of(name, operands), flops, name)

    def test_bytes_of_an_access(self) -> None:
        for name, operands, size in [("vmovupd", "(%rax,%rcx,8),%ymm1", 32), ("vmovsd", "(%rax),%xmm1", 8),
                                     ("vaddsd", "(%rax),%xmm1,%xmm1", 8), ("vbroadcastsd", "0x10(%rip),%ymm2", 8),
                                     ("vinsertf128", "$0x1,(%rax),%ymm1,%ymm1", 16), ("mov", "(%rax),%edx", 4),
                                     ("mov", "%rdx,(%rax)", 8), ("movb", "$0x1,(%rax)", 1), ("cmpl", "$0x0,0x8(%r12)", 4),
                                     ("push", "%rbp", 8), ("call", "401000 <f>", 8), ("vmovhpd", "(%rax),%xmm1,%xmm2", 8), ("ret", "", 8),
                                     ("mov", "%r8d,(%rax)", 4), ("mov", "%r10,(%rax)", 8), ("mov", "%al,(%rdx)", 1),
                                     ("movslq", "(%rax),%rdx", 4), ("movzbl", "(%rax),%edx", 1), ("movapd", "(%rsp),%xmm3", 16)]:
            self.assertEqual(bytes_of(name, operands), size, f"{name} {operands}")


class Profiles(unittest.TestCase):
    def test_calls_are_not_counted_twice_and_libraries_have_misses_only(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            profile = Path(folder) / "profile"
            profile.write_text("events: Ir Dr Dw DLmr DLmw\nob=/x/program\nfn=a::chords\n0x10 0 5 5 0 1 0\n0x14 0 5\n"
                               "calls=1 0x20 0\n0x14 0 1000 1000 1000 9 9\nfn=b\n0x20 0 3 0 3 0 2\nob=/lib/libm.so\nfn=sin\n0x10 0 7 7 0 1 0\n")
            code = {0x10: ("vmulpd", "(%rax),%ymm1,%ymm2"), 0x14: ("vaddsd", "%xmm1,%xmm1,%xmm1"), 0x20: ("vmovsd", "%xmm1,(%rax)")}
            original, count_kernels.disassembly = count_kernels.disassembly, lambda program: code
            try:
                work = count_kernels.work_by_function(profile, Path("/x/program"))
            finally:
                count_kernels.disassembly = original
        self.assertEqual(work["a::chords"], Work(5 * 4 + 5, 5 * 32, 64))
        self.assertEqual(work["b"], Work(0, 3 * 8, 128))
        self.assertEqual(work["sin"], Work(0, 0, 64))

    def test_a_function_belongs_to_the_first_kernel_that_names_it(self) -> None:
        found = parts({"x::load_block": Work(1, 2, 3), "x::load": Work(10, 20, 30), "rest": Work(100, 200, 300)},
                      [("sums", ["load_block"]), ("pressures", ["::load"])])
        self.assertEqual(found, {"sums": Work(1, 2, 3), "pressures": Work(10, 20, 30), "whole step": Work(111, 222, 333)})


class Committed(unittest.TestCase):
    def test_counts_are_of_the_kernels_that_are_there(self) -> None:
        import tomllib
        kernels = {(one["method"], one["title"])
                   for one in tomllib.loads((BENCH / "scaling/kernels.toml").read_text())["kernel"]}
        counts = BENCH / "scaling/kernels.csv"
        rows = [line.split(",") for line in counts.read_text().splitlines() if line[0] != "#"][1:]
        self.assertTrue(rows)
        for method, title, *numbers in rows:
            self.assertTrue(title == "whole step" or (method, title) in kernels, title)
            self.assertTrue(all(float(number) >= 0.0 for number in numbers))


if __name__ == "__main__":
    unittest.main()
