// Parts of objects that a target lacks: refused, or left out.
#pragma once

#include <string>
#include <vector>

#include "scene_export/scene_export.h"

import candela.api;
import candela.scene;

namespace candela {

/// An object's name as targets write it, into comments and pages: without line breaks, which would end them.
std::string name_in(const Label& label);

/// Throws Error if the object has something that the target lacks and the request does not leave out.
void require_abilities(const Object& object, const ExportRequest& request);

/// Sentences about what require_abilities() accepted although the target lacks it.
std::vector<std::string> left_out_of(const Object& object, const TargetAbilities& abilities);

}  // namespace candela
