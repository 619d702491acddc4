// Views of OpenColorIO configurations, by the program candela-color-view.
#pragma once

#include <memory>
#include <string>

#include "process/process.h"

import candela.render;

/// A view of a display. Empty names stand for the configuration's defaults.
struct ViewName {
    std::string config;  // a file; empty: the environment variable OCIO
    std::string display, view;
};

class ColorView {
  public:
    /// Starts the program. Throws candela::Error if it is not installed or finds no configuration.
    explicit ColorView(ViewName name);

    /// Everything that names it, and its configuration's file, whether or not there is one.
    std::string text() const;
    const std::string& config() const { return config_; }

    /// Waits until the view is found. Throws candela::Error (bad_request), with the known views or displays.
    void require();

    /// The 8-bit picture of intensities, which are multiplied by `exposure` first. Throws candela::Error.
    candela::Film applied(const candela::Film& intensity, float exposure);

  private:
    std::string ask(const std::string& line);

    ViewName name_;
    std::string config_;
    std::unique_ptr<candela::AnsweringProgram> program_;
};
