#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <string>

#include "common/errors.hpp"
#include "viz/render/graphics.hpp"

namespace softgrain {
namespace {

constexpr int start_limit_ms = 20000;

/// What the child of fork() does: only calls that are safe there.
[[noreturn]] void become_xvfb(const char* descriptor_text) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
    ::execlp("Xvfb", "Xvfb", "-displayfd", descriptor_text, "-screen", "0", "1280x1024x24", "-nolisten",
             "tcp", static_cast<char*>(nullptr));
    ::_exit(127);
}

/// A server that is ended, and waited for, with the object.
class XvfbServer {
  public:
    XvfbServer() {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw OutputError("Xvfb: cannot make a pipe");
        const std::string descriptor_text = std::to_string(ends[1]);
        child_ = ::fork();
        if (child_ == 0) {
            ::fcntl(ends[1], F_SETFD, 0);
            become_xvfb(descriptor_text.c_str());
        }
        ::close(ends[1]);
        const std::string number = child_ > 0 ? read_line(ends[0]) : std::string();
        ::close(ends[0]);
        if (number.empty()) {
            end();
            throw OutputError("Xvfb: cannot be started (package xvfb)");
        }
        display_ = ":" + number;
    }
    XvfbServer(const XvfbServer&) = delete;
    XvfbServer& operator=(const XvfbServer&) = delete;
    ~XvfbServer() { end(); }

    const std::string& display() const { return display_; }

  private:
    /// The first line, or "" if it does not come in time.
    static std::string read_line(int descriptor) {
        std::string line;
        char c = 0;
        for (;;) {
            pollfd waiting{descriptor, POLLIN, 0};
            const int ready = ::poll(&waiting, 1, start_limit_ms);
            if (ready < 0 && errno == EINTR) continue;
            if (ready <= 0 || ::read(descriptor, &c, 1) != 1) return {};
            if (c == '\n') return line;
            line += c;
        }
    }
    void end() {
        if (child_ <= 0) return;
        ::kill(child_, SIGTERM);
        while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
        }
        child_ = -1;
    }

    pid_t child_ = -1;
    std::string display_;
};

class XvfbGraphics final : public Graphics {
  public:
    XvfbGraphics() { ::setenv("DISPLAY", server_.display().c_str(), 1); }

    vtkSmartPointer<vtkRenderWindow> make_window(int width, int height) override {
        auto window = vtkSmartPointer<vtkRenderWindow>::New();
        window->SetOffScreenRendering(1);
        window->SetSize(width, height);
        return window;
    }

  private:
    XvfbServer server_;
};

}  // namespace

std::unique_ptr<Graphics> open_xvfb_graphics() {
    return std::make_unique<XvfbGraphics>();
}

}  // namespace softgrain
