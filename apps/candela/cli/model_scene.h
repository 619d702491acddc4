// Models given in place of scenes.
#pragma once

#include <string>

import candela.plugins;

/// Call this before anything is reported if a model is given: where models are read elsewhere
/// (cli/elsewhere.h), it does not return.
void expect_models();

/// How models are read.
struct ModelOptions {
    bool allow_outside = false;
    bool with_animation = false;
    bool with_studio = true;
    int threads = 0;  // 0: all available
};

/// The scene that shows a model. It is made once; so are the files of pictures embedded in the model, which
/// live as long as the command. Reports what is lost.
const std::string& scene_of_model(const std::string& file, const ModelOptions& options,
                                  candela::Registry& registry);

/// Call this once the scene of a model has been compiled. Until then its triangles are kept, so that the file
/// is read only once.
void forget_triangles_of_models();
