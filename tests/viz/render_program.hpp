#pragma once
// softgrain-render as its users call it.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "rendering.hpp"

namespace softgrain {

class RenderProgram : public Rendering {
  protected:
    struct Outcome {
        int exit_code;
        std::string out, err;
    };
    /// `environment` stands before the program, as in PATH=/nowhere.
    Outcome render(const std::string& arguments, const std::string& environment = "") const {
        const std::filesystem::path out = folder.path() / "out.txt", err = folder.path() / "err.txt";
        const std::string command = environment + " " SOFTGRAIN_RENDER_EXE " " + arguments + " > " +
                                    out.string() + " 2> " + err.string();
        const int status = std::system(command.c_str());
        return {WEXITSTATUS(status), content(out), content(err)};
    }
    static std::string content(const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::string path_of(const std::string& name) const { return folder.path() / name; }
    /// This machine has no graphics at all.
    bool missing_graphics(const Outcome& outcome) const {
        return outcome.exit_code == 4 && missing(outcome.err);
    }
};

}  // namespace softgrain
