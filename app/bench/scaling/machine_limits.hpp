#pragma once
// What one core of this machine does at most: arithmetic and memory, measured.
namespace softgrain::bench {

struct MachineLimits {
    double flops = 0.0;  ///< double operations in multiplications followed by additions [1/s]
    double fused_flops =
        0.0;              ///< the same fused, which softgrain does without; 0 if the processor cannot [1/s]
    double cache = 0.0;   ///< bytes loaded and stored by a triad in 24 KB [bytes/s]
    double memory = 0.0;  ///< by a triad in 192 MB [bytes/s]
};

/// Best of several tries of about 10 ms of CPU time each, one thread.
MachineLimits machine_limits();

}  // namespace softgrain::bench
