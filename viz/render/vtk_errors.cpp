#include "viz/render/vtk_errors.hpp"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <utility>

namespace softgrain {
namespace {

std::string first_error;

class ErrorCollector : public vtkOutputWindow {
  public:
    static ErrorCollector* New();
    vtkTypeMacro(ErrorCollector, vtkOutputWindow);
    void DisplayText(const char*) override {}
    void DisplayWarningText(const char*) override {}
    void DisplayGenericWarningText(const char*) override {}
    void DisplayDebugText(const char*) override {}
    void DisplayErrorText(const char* text) override {
        if (!first_error.empty()) return;
        first_error = text;
        while (!first_error.empty() && first_error.back() == '\n') first_error.pop_back();
        for (char& c : first_error)
            if (c == '\n') c = ' ';
    }

  protected:
    ErrorCollector() = default;
};
vtkStandardNewMacro(ErrorCollector);

}  // namespace

void collect_vtk_errors() {
    vtkNew<ErrorCollector> collector;
    vtkOutputWindow::SetInstance(collector);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

std::string take_vtk_error() {
    return std::exchange(first_error, {});
}

}  // namespace softgrain
