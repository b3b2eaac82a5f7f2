#include "app/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "app/methods.hpp"
#include "app/report/curves.hpp"
#include "app/report/figure.hpp"
#include "app/report/force_plots.hpp"
#include "app/report/html.hpp"
#include "app/report/limits.hpp"
#include "app/report/style.hpp"
#include "app/report/tables.hpp"
#include "app/report/verdict.hpp"
#include "app/report/words.hpp"
#include "common/io/scenario_file.hpp"
#include "common/io/scenario_stages.hpp"
#include "viz/markup.hpp"

namespace softgrain::report {
namespace {

std::string value_text(const Value& value) {
    if (const auto* number = std::get_if<double>(&value)) return fmt::format("{:g}", *number);
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
    if (const auto* yes = std::get_if<bool>(&value)) return *yes ? "true" : "false";
    const auto* text = std::get_if<std::string>(&value);
    return text ? *text : "";
}

/// "isotropic, inertial number 0.001, until packing fraction 0.95".
std::string stage_text(const LoadingStage& stage) {
    const Settings settings = scenario_io::settings_of(stage);
    std::string text = settings.text("kind");
    for (const auto& [key, value] : settings.values()) {
        if (key == "kind") continue;
        std::string words = key;
        std::replace(words.begin(), words.end(), '_', ' ');
        text += fmt::format(", {} {}", words, value_text(value));
    }
    return text;
}

/// Rates that a method's own table gives in place of the scenario's, or that the method has by itself.
std::string own_rate(const Scenario& scenario, const std::string& method) {
    const Settings& settings = scenario.method_settings.at(method);
    for (const auto* key : {"inertial_number", "strain_rate"})
        if (settings.has(key))
            return fmt::format("{}: {} {:g}", method,
                               key == std::string_view("strain_rate") ? "strain rate" : "inertial number",
                               settings.number(key));
    const bool none_named = std::ranges::any_of(scenario.loading, [](const LoadingStage& stage) {
        return stage.has_rate() && !stage.strain_rate && !stage.inertial_number;
    });
    return none_named ? fmt::format("{}: inertial number {:g}", method, find_method(method).inertial_number)
                      : "";
}

/// What all runs say alike, once; else each with its method.
template <typename Get>
std::string of_all(const std::vector<MethodResult>& results, Get get) {
    std::vector<std::string> each;
    bool alike = true;
    for (const MethodResult& result : results) {
        alike = alike && get(result.report) == get(results.front().report);
        each.push_back(fmt::format("{} ({})", get(result.report), result.report.method));
    }
    return alike ? get(results.front().report) : listed(each);
}

std::string what_was_run(const PageContent& content) {
    const Scenario& scenario = content.scenario;
    const auto& results = content.results;
    std::vector<std::pair<std::string, Cell>> lines;
    const auto add = [&](const std::string& name, const std::string& text) {
        if (!text.empty()) lines.emplace_back(name, text_cell(text));
    };
    add("Scenario", scenario.source.string());
    add("Grains",
        fmt::format("{}, undeformed packing fraction {}, box {:.4g} m \u00d7 {:.4g} m{}",
                    content.packing.size(), packing_fraction(content.packing.packing_fraction_undeformed()),
                    content.packing.box.width(), content.packing.box.height(),
                    content.packing.box.periodic ? ", periodic" : ""));
    std::string loading;
    for (const LoadingStage& stage : scenario.loading) loading += element("p", stage_text(stage));
    lines.push_back({"Loading", {loading}});
    std::vector<std::string> rates;
    for (const MethodResult& result : results)
        if (const auto rate = own_rate(scenario, result.report.method); !rate.empty()) rates.push_back(rate);
    add("Rates of their own", listed(rates));
    add("Seed", fmt::format("{}", scenario.seed));
    add("Version", of_all(results, [](const RunReport& r) {
            return fmt::format("softgrain {}, commit {}", r.version, r.commit);
        }));
    add("Threads", of_all(results, [](const RunReport& r) {
            return fmt::format("{}{}", r.threads, r.processor.empty() ? "" : " of " + r.processor);
        }));
    add("Date", std::ranges::max_element(results, {}, [](const MethodResult& r) {
                    return r.report.finished;
                })->report.finished);
    for (const std::string& note : content.notes) add("Note", note);
    return facts(lines) + "<details><summary>Scenario with every key</summary>\n<pre>" +
           escape_markup(write_scenario(scenario, method_keys())) + "</pre></details>\n";
}

std::string curves_section(const PageContent& content) {
    const auto plot = [&](std::string_view column, const std::string& title, const std::string& label,
                          bool log) {
        return curve_plot(title, content.results, content.reference, column, label, log);
    };
    std::vector<PlotSpec> plots{plot("mean_stress", "Mean stress", "mean stress [N/m]", true),
                                plot("coordination_number", "Coordination", "coordination number Z", false)};
    if (has_deviatoric_stress(content.results))
        plots.push_back(
            plot("deviatoric_stress", "Deviatoric stress", "(\u03c3xx \u2212 \u03c3yy) / 2 [N/m]", false));
    std::string out = figures(plots);
    if (content.reference && content.reference->history.columns.contains("mean_stress_error"))
        out += "<p class=\"note\">The band is the reference's own error, as given with it.</p>\n";
    return out;
}

std::string heading(const char* text) {
    return element("h2", text);
}

}  // namespace

std::string page(const PageContent& content) {
    const auto truth = find_truth(content.results, content.reference);
    const std::string title = content.scenario.title.empty() ? "Comparison" : content.scenario.title;
    std::vector<std::string> names;
    for (const MethodResult& result : content.results) names.push_back(result.report.method);
    std::string out =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'; script-src 'unsafe-inline'\">\n" +
        element("title", title) + "<style>" + style_sheet + "</style>\n</head>\n<body>\n<header>\n" +
        element("h1", title) +
        element("p", fmt::format("One packing of {} grains through {}: what each gives, and what it costs.",
                                 content.packing.size(), listed(names))) +
        "</header>\n";
    out += "<section class=\"verdict\">\n";
    for (const std::string& sentence : verdict(content.results, truth)) out += element("p", sentence);
    out += "</section>\n" + heading("What was run") + what_was_run(content);
    out += heading("Methods") + methods_table(content.results, truth);
    out += heading("Curves") + curves_section(content);
    if (content.pictures)
        out += heading("Pictures side by side") + pictures_section(content.results, *content.pictures);
    out += heading("Distribution of normal forces") + force_section(content.results, content.folder);
    out += heading("Energy") + energy_table(content.results);
    out += heading("What each method could not do") +
           limits_section(content.results, content.scenario, content.packing);
    return out + "<script>" + script + "</script>\n</body>\n</html>\n";
}

}  // namespace softgrain::report
