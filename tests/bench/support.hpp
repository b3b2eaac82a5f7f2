#pragma once
// Rows of a bench that was not run.
#include <memory>
#include <string>

#include "app/bench/rows.hpp"

namespace softgrain::bench {

/// A case and its rows, with what they point to.
class MadeUp {
  public:
    explicit MadeUp(const std::string& name) {
        case_->name = case_->title = name;
        case_->reference = name + ".csv";
        case_->quantities[stress].emplace();
        rows.of = case_.get();
    }
    /// `setting` may be that of another case.
    Row& add(const Setting& setting, double cpu, double error, double coverage = 1.0, int exit_code = 0) {
        Row row{&setting, {}, 3, {cpu, cpu, 2.0 * cpu, cpu, 5e7}, {}, coverage};
        row.report.method = setting.method;
        row.report.ended = exit_code == 0 ? "loading done" : "diverged: at once";
        row.report.exit_code = exit_code;
        row.report.steps = 10;
        row.error[stress] = error;
        rows.rows.push_back(row);
        return rows.rows.back();
    }

    CaseRows rows;

  private:
    std::unique_ptr<Case> case_ = std::make_unique<Case>();
};

inline Setting setting(const std::string& method, const std::string& label) {
    return {method, "knob", label, {method + "." + label}, {}, 1};
}

}  // namespace softgrain::bench
