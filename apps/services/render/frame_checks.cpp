#include "render/frame_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

import candela.plugins;
import candela.render;
import candela.scene;
import candela.util;

namespace candela {

namespace {

/// A problem found in one frame, and perhaps in others with different numbers.
struct Finding {
    Diagnostic diagnostic;
    bool is_failure = false;
    int first_frame = 0;
    std::size_t frames = 0;
    int last_frame = -1;  // the last frame in which it was counted
};

std::string without_numbers(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if ((c < '0' || c > '9') && c != '.' && c != '-') result += c;
    }
    return result;
}

/// The track that has a key at that position.
const Track* track_at(const std::optional<Animation>& animation, const SourceLocation& place) {
    if (!animation) return nullptr;
    const auto has_it = [&](const Track& track) {
        return std::ranges::find(track.keys, place, &Key::place) != track.keys.end();
    };
    const auto found = std::ranges::find_if(animation->tracks, has_it);
    return found != animation->tracks.end() ? &*found : nullptr;
}

class FrameChecker {
  public:
    void add(const Diagnostics& found, int frame) {
        const bool is_failure = found.worst() == ErrorCategory::failure;
        for (Diagnostic& diagnostic : found.sorted()) {
            const auto key = std::tuple(diagnostic.severity, diagnostic.place.file, diagnostic.place.line,
                                        diagnostic.place.column, without_numbers(diagnostic.message));
            const auto [known, is_new] = index_.try_emplace(key, findings_.size());
            if (is_new) findings_.push_back({std::move(diagnostic), is_failure, frame, 0, -1});
            Finding& finding = findings_[known->second];
            if (finding.last_frame != frame) ++finding.frames;
            finding.last_frame = frame;
        }
    }

    void report(const std::optional<Animation>& animation, std::size_t frames, Diagnostics& to) {
        for (Finding& finding : findings_) {
            Diagnostic& d = finding.diagnostic;
            const Track* const track = track_at(animation, d.place);
            std::string note;
            if (track != nullptr) note = fmt::format("by the track of '{}'", track->path);
            if (animation && (track != nullptr || finding.frames < frames)) {
                note = fmt::format(
                    "in frame {}{}{}{}", finding.first_frame, note.empty() ? "" : ", ", note,
                    finding.frames > 1 ? fmt::format(", and in {} more", finding.frames - 1) : "");
            }
            if (!note.empty()) d.message += fmt::format(" ({})", note);
            if (d.severity == Severity::warning) {
                to.warning(d.place, d.message, d.hint, d.help);
            } else if (finding.is_failure) {
                to.failure(d.place, d.message, d.hint, d.help);
            } else {
                to.error(d.place, d.message, d.hint, d.help);
            }
        }
    }

  private:
    std::map<std::tuple<Severity, std::string, int, int, std::string>, std::size_t> index_;
    std::vector<Finding> findings_;
};

}  // namespace

void check_frames(SceneFrames& frames, std::span<const int> numbers, Registry& registry,
                  Diagnostics& diagnostics, int threads, const Progress& progress) {
    FrameBuilder builder(registry);
    FrameChecker checker;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        Diagnostics found;
        const SceneDraft draft = frames.draft(numbers[i], found);
        static_cast<void>(builder.build(draft, found, threads));
        checker.add(found, numbers[i]);
        if (progress) progress(i + 1, numbers.size());
    }
    checker.report(frames.animation(), numbers.size(), diagnostics);
}

}  // namespace candela
