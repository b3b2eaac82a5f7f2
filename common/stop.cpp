#include "common/stop.hpp"

namespace softgrain {
namespace {

constinit std::atomic<int> requested{0};
static_assert(std::atomic<int>::is_always_lock_free, "set from signal handlers");

}  // namespace

std::atomic<int>& stop_request() {
    return requested;
}

StopAsked::StopAsked() : std::runtime_error("stopped by a signal") {}

void heed_stop() {
    if (requested != 0) throw StopAsked();
}

}  // namespace softgrain
