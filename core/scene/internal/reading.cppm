module candela.scene:reading;

import :content;
import :document;
import :request;
import candela.plugins;
import candela.util;

namespace candela {

/// Validates a document and reports all problems.
SceneDraft read_draft(const SceneRequest& request, const MergedDocument& document, Registry& registry,
                      Diagnostics& diagnostics);

}  // namespace candela
