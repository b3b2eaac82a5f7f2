#include "app/bench/scaling/scaling_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "app/bench/plan_reader.hpp"
#include "app/bench/scaling/tiles.hpp"
#include "common/errors.hpp"

namespace softgrain::bench {
namespace {

constexpr Range from_one{1.0, 1e9};

const std::vector<KeySpec>& subject_keys() {
    static const std::vector<KeySpec> keys{text_key("name"),
                                           text_key("method"),
                                           text_key("scenario"),
                                           text_key("set"),
                                           text_key("counts"),
                                           text_key("threads"),
                                           {"warm_up", KeyType::integer, Value{}, "", "", from_one},
                                           {"least_steps", KeyType::integer, Value{}, "", "", from_one},
                                           {"work", KeyType::number, Value{}, "", "", positive},
                                           {"profile_count", KeyType::integer, Value{}, "", "", from_one}};
    return keys;
}

class SubjectReader : PlanReader {
  public:
    using PlanReader::PlanReader;

    ScalingPlan read() {
        ScalingPlan plan;
        plan.source = path_;
        known_tables({"subject"});
        needed("subject");
        for (const CheckedTable& table : tables("subject", subject_keys(),
                                                {"name", "method", "scenario", "counts", "threads", "warm_up",
                                                 "least_steps", "work", "profile_count"}))
            if (is_method(table)) plan.subjects.push_back(subject_of(table, plan));
        errors_.throw_if_any();
        return plan;
    }

  private:
    Subject subject_of(const CheckedTable& table, const ScalingPlan& plan) {
        const Settings& given = table.settings;
        Subject one{given.text("name"),
                    given.text("method"),
                    file(table, "scenario"),
                    parts(text(table, "set")),
                    numbers(table, "counts"),
                    numbers(table, "threads"),
                    static_cast<int>(given.integer("warm_up")),
                    static_cast<int>(given.integer("least_steps")),
                    given.number("work"),
                    static_cast<int>(given.integer("profile_count"))};
        if (std::ranges::find(plan.subjects, one.name, &Subject::name) != plan.subjects.end())
            add_error(table, "name", "names another subject already");
        if (!std::filesystem::exists(one.scenario))
            add_error(table, "scenario", fmt::format("there is no file {}", one.scenario.string()));
        std::ranges::sort(one.counts);
        for (const int count : one.counts) try {
                copies_of(count);
            } catch (const InputError& error) {
                add_error(table, "counts", error.what());
            }
        if (std::ranges::find(one.counts, one.profile_count) == one.counts.end())
            add_error(table, "profile_count", "must be one of the counts");
        return one;
    }

    std::vector<int> numbers(const CheckedTable& table, std::string_view key) {
        std::vector<int> all;
        for (const std::string& word : parts(table.settings.text(key))) {
            int value = 0;
            const char* end = word.data() + word.size();
            const auto [stop, error] = std::from_chars(word.data(), end, value);
            if (error != std::errc{} || stop != end || value < 1)
                add_error(table, key, fmt::format("must be whole numbers >= 1, got \"{}\"", word));
            else
                all.push_back(value);
        }
        if (all.empty()) add_error(table, key, "must be at least one, parted by commas");
        return all;
    }
};

class KernelReader : PlanReader {
  public:
    using PlanReader::PlanReader;

    std::vector<Kernel> read() {
        static const std::vector<KeySpec> keys{text_key("method"), text_key("title"), text_key("functions")};
        std::vector<Kernel> kernels;
        known_tables({"kernel"});
        for (const CheckedTable& table : tables("kernel", keys, {"method", "title", "functions"})) {
            const Settings& given = table.settings;
            if (is_method(table))
                kernels.push_back(
                    {given.text("method"), given.text("title"), parts(given.text("functions"))});
            if (given.text("title").find(',') != std::string::npos)
                add_error(table, "title", "must be without commas, as it stands in a CSV file");
        }
        errors_.throw_if_any();
        return kernels;
    }
};

/// As bench/scaling/count_kernels.py writes them.
std::vector<KernelCount> read_counts(const std::filesystem::path& path) {
    std::vector<KernelCount> all;
    std::ifstream file(path);
    int number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        if (line.starts_with('#') || line.starts_with("method,")) continue;
        KernelCount one{};
        std::istringstream words(line);
        char comma = 0;
        if (!std::getline(words, one.method, ',') || !std::getline(words, one.title, ',') ||
            !(words >> one.flops >> comma >> one.bytes >> comma >> one.far_bytes))
            throw InputError(
                fmt::format("{}:{}: must be method,kernel,flops,bytes,far_bytes: make the file anew with "
                            "bench/scaling/count_kernels.py --update",
                            path.string(), number));
        all.push_back(std::move(one));
    }
    return all;
}

}  // namespace

int Subject::steps(int count) const {
    return std::max(least_steps, static_cast<int>(std::lround(work / count)));
}

ScalingPlan read_scaling_plan(const std::filesystem::path& path) {
    ScalingPlan plan = SubjectReader(path).read();
    const std::filesystem::path kernels = path.parent_path() / "kernels.toml";
    if (std::filesystem::exists(kernels)) plan.kernels = KernelReader(kernels).read();
    plan.counts = read_counts(path.parent_path() / "kernels.csv");
    return plan;
}

}  // namespace softgrain::bench
