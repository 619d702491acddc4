module candela.scene:reading;

import :content;
import :merge;
import :request;
import candela.diagnostics;
import candela.registry;

namespace candela {

/// Validates a document and reports all problems.
SceneDraft read_draft(const SceneRequest& request, const MergedDocument& document, Registry& registry,
                      Diagnostics& diagnostics);

}  // namespace candela
