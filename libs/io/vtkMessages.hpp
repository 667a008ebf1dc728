// Catches the messages that VTK would print about errors, to make them part of the exception's text.
#pragma once
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>
#include <vtkStringOutputWindow.h>

#include <string>

namespace corpuscle::io {

class VtkMessages {
  public:
    VtkMessages() : before_(vtkOutputWindow::GetInstance()), loudness_(vtkLogger::GetCurrentVerbosityCutoff()) {
        vtkOutputWindow::SetInstance(window_);
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    }
    ~VtkMessages() {
        vtkOutputWindow::SetInstance(before_);
        vtkLogger::SetStderrVerbosity(loudness_);
    }
    VtkMessages(const VtkMessages&) = delete;
    VtkMessages& operator=(const VtkMessages&) = delete;

    bool any() { return !window_->GetOutput().empty(); }
    // The first message without VTK's source line: "ERROR: In file.cxx, line 1\nvtkX (0x1): text".
    std::string first() {
        std::string text = window_->GetOutput();
        if (const auto line = text.find('\n'); text.starts_with("ERROR: In ") && line != std::string::npos)
            text.erase(0, line + 1);
        if (const auto name = text.find("): "); name != std::string::npos) text.erase(0, name + 3);
        return text.substr(0, text.find('\n'));
    }

  private:
    vtkSmartPointer<vtkOutputWindow> before_;
    vtkLogger::Verbosity loudness_;
    vtkNew<vtkStringOutputWindow> window_;
};

}  // namespace corpuscle::io
