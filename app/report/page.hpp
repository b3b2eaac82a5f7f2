#pragma once
// report.html: a comparison on one page that needs no other file and no network.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/comparison_table.hpp"
#include "app/report/pictures.hpp"
#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain::report {

struct PageContent {
    const Scenario& scenario;
    const Packing& packing;
    const std::filesystem::path& folder;  ///< of the comparison
    const std::vector<MethodResult>& results;
    const std::optional<Reference>& reference;
    std::vector<std::string> notes;    ///< more about what was run
    std::optional<Pictures> pictures;  ///< none: they were not asked for
};

std::string page(const PageContent& content);

}  // namespace softgrain::report
