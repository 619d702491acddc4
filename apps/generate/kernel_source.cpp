#include "kernel_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

namespace generate {

namespace {

std::string without_comments(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        if (text.compare(i, 2, "//") == 0) {
            i = std::min(text.find('\n', i), text.size());
        } else if (text.compare(i, 2, "/*") == 0) {
            const std::size_t end = text.find("*/", i + 2);
            i = end == std::string::npos ? text.size() : end + 2;
            result += ' ';
        } else {
            result += text[i++];
        }
    }
    return result;
}

std::vector<std::smatch> all_matches(const std::string& text, const std::regex& pattern) {
    return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

std::vector<KernelMember> members_of(const std::string& body) {
    static const std::regex k_member(R"((\w+)\s+(\w+)\s*;)");
    std::vector<KernelMember> members;
    for (const std::smatch& m : all_matches(body, k_member)) members.push_back({m[1], m[2]});
    return members;
}

std::vector<std::string> types_of(const std::string& parameters) {
    static const std::regex k_parameter(R"((\w+)\s+\w+)");
    std::vector<std::string> types;
    for (const std::smatch& m : all_matches(parameters, k_parameter)) types.push_back(m[1]);
    return types;
}

/// The words of a text, but for those of the standard library.
std::set<std::string> words_of(const std::string& text) {
    static const std::regex k_word(R"((std::)?([A-Za-z_]\w*))");
    std::set<std::string> words;
    for (const std::smatch& m : all_matches(text, k_word)) {
        if (!m[1].matched) words.insert(m[2]);
    }
    return words;
}

struct Paragraph {
    std::string text;
    std::vector<std::string> declares{};
    bool is_kept = false;
};

std::vector<Paragraph> paragraphs_of(const std::string& text) {
    static const std::regex k_declared(
        R"((?:^|\n)(?:struct\s+(\w+)\s*\{|(?:KERNEL|inline|static|const)\s[\w\s:<>,]*?(\w+)\s*[({=]))");
    std::vector<Paragraph> all;
    std::istringstream lines(text);
    std::string line, current;
    const auto end = [&] {
        if (current.empty()) return;
        Paragraph p{.text = current};
        const std::string code = without_comments(current);
        for (const std::smatch& m : all_matches(code, k_declared))
            p.declares.push_back(m[1].matched ? m[1] : m[2]);
        all.push_back(std::move(p));
        current.clear();
    };
    while (std::getline(lines, line)) {
        if (line.empty()) {
            end();
        } else {
            current += line + '\n';
        }
    }
    end();
    return all;
}

}  // namespace

KernelSource::KernelSource(std::string text, std::string prefix, std::string parameters)
    : text_(std::move(text)), prefix_(std::move(prefix)), parameters_(std::move(parameters)) {
    const std::string code = without_comments(text_);
    static const std::regex k_struct(R"(struct\s+(\w+)\s*\{([^}]*)\})");
    for (const std::smatch& m : all_matches(code, k_struct)) structs_.push_back({m[1], members_of(m[2])});
    static const std::regex k_function(R"(KERNEL\s+(\w+)\s+(\w+)\s*\(([^)]*)\))");
    for (const std::smatch& m : all_matches(code, k_function))
        functions_.push_back({m[1], m[2], types_of(m[3])});
}

const KernelStruct* KernelSource::parameters() const {
    const auto found = std::ranges::find(structs_, parameters_, &KernelStruct::name);
    return found == structs_.end() ? nullptr : &*found;
}

const KernelFunction* KernelSource::function(std::string_view suffix) const {
    const auto found =
        std::ranges::find(functions_, fmt::format("{}_{}", prefix_, suffix), &KernelFunction::name);
    return found == functions_.end() ? nullptr : &*found;
}

std::string KernelSource::call(std::string_view suffix, std::string_view parameters,
                               std::string_view arguments) const {
    const KernelFunction* const f = function(suffix);
    const bool takes_them = f != nullptr && !parameters_.empty() && !f->parameter_types.empty() &&
                            f->parameter_types.front() == parameters_;
    return fmt::format("{}_{}({}{}{})", prefix_, suffix, takes_them ? parameters : "",
                       takes_them && !arguments.empty() ? ", " : "", arguments);
}

std::vector<std::string> KernelSource::names() const {
    std::vector<std::string> names;
    for (const KernelStruct& s : structs_) names.push_back(s.name);
    for (const KernelFunction& f : functions_) names.push_back(f.name);
    return names;
}

std::string needed_parts(const std::string& library, const std::string& users) {
    std::vector<Paragraph> all = paragraphs_of(library);
    std::set<std::string> wanted = words_of(without_comments(users));
    for (bool has_grown = true; has_grown;) {
        has_grown = false;
        for (Paragraph& p : all) {
            if (p.is_kept) continue;
            p.is_kept = p.declares.empty() || std::ranges::any_of(p.declares, [&](const std::string& name) {
                            return wanted.contains(name);
                        });
            if (!p.is_kept) continue;
            wanted.merge(words_of(without_comments(p.text)));
            has_grown = true;
        }
    }
    std::string result;
    for (const Paragraph& p : all) {
        if (p.is_kept) result += (result.empty() ? "" : "\n") + p.text;
    }
    return result;
}

}  // namespace generate
