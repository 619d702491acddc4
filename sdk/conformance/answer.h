// An answer to an exercise: another kernel text for a model, whose results are compared with the model's.
#pragma once

#include <string>

/// The group that judges an answer; the text is the whole kernel. Its result is one warning, a JSON object:
///   {"refused": "what the compiler says"}, {"signal": "SEGV"}, {"hangs": true}, or
///   {"matches": true, "points": 20000, "terms": [{"term": "diffuse", "share": 0.5 (of the points that
///    differ), "largest": 0.2 (difference, as a part of the term's largest value there), "expected": 0.4,
///    "actual": 0.3, "at": "N = …", "with": "kd=0.5"}]}
inline constexpr const char* k_answer_group = "answer: it computes the same numbers as the model";

/// The text that the group judges; set once in each child.
void set_answer(std::string text);
