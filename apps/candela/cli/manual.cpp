#include "cli/manual.h"

#include <cctype>
#include <string_view>

namespace po = boost::program_options;

namespace {

/// Text that troff prints unchanged: no escapes, hyphens that can be copied, and no line that looks like a
/// request.
std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n')) result += "\\&";
        if (c == '\\') {
            result += "\\e";
        } else if (c == '-') {
            result += "\\-";
        } else {
            result += c;
        }
    }
    return result;
}

std::string heading(std::string_view name) {
    std::string upper;
    for (const char c : name) upper += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return ".TH \"" + escaped(upper) + "\" 1 \"\" Candela \"Candela's manual\"\n";
}

/// The NAME section, which the index of manual pages shows, starts in lower case: "render a scene".
std::string first_sentence(std::string_view explanation) {
    std::string result;
    for (std::size_t i = 0; i < explanation.size(); ++i) {
        const char c = explanation[i];
        const bool ends =
            i + 1 == explanation.size() || explanation[i + 1] == ' ' || explanation[i + 1] == '\n';
        if ((c == '.' || c == ':') && ends) break;
        result += c == '\n' ? ' ' : c;
    }
    if (!result.empty()) result[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(result[0])));
    return result;
}

/// Reads text like wrapped_paragraphs(): a line that begins with spaces is a row of two columns.
std::string paragraphs(std::string_view text) {
    std::string result = ".PP\n";
    bool is_in_rows = false;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t margin = std::min(line.find_first_not_of(' '), line.size());
        if (line.empty()) {
            result += ".PP\n";
        } else if (margin == 0) {
            if (is_in_rows) result += ".PP\n";
            is_in_rows = false;
            result += escaped(line) + '\n';
        } else {
            const std::size_t gap = line.find("  ", margin);
            const std::size_t right = gap == std::string_view::npos ? gap : line.find_first_not_of(' ', gap);
            is_in_rows = true;
            result += ".TP\n.B " + escaped(line.substr(margin, gap - margin)) + '\n';
            if (right != std::string_view::npos) result += escaped(line.substr(right)) + '\n';
        }
    }
    return result;
}

std::string option_text(const po::option_description& option) {
    const std::string brief = option.canonical_display_name(po::command_line_style::allow_dash_for_short);
    const std::string long_name = "--" + option.long_name();
    std::string result = ".TP\n\\fB";
    if (brief.starts_with('-')) result += escaped(brief) + "\\fR, \\fB";
    result += escaped(long_name) + "\\fR";
    const std::string value = option.format_parameter();
    if (!value.empty()) result += " \\fI" + escaped(value) + "\\fR";
    return result + '\n' + escaped(option.description()) + '\n';
}

constexpr const char* k_exit_status =
    ".SH EXIT STATUS\n"
    ".TP\n.B 0\nSuccess.\n"
    ".TP\n.B 1\nA file could not be read or written, or something failed while running.\n"
    ".TP\n.B 2\nWrong usage.\n"
    ".TP\n.B 3\nThe scene is invalid.\n"
    ".TP\n.B 4\nA verification or comparison failed.\n";

}  // namespace

std::string manual_page(const std::string& usage, const std::string& explanation,
                        const po::options_description& options) {
    // In "candela plugin new KIND NAME", the lower-case words are the verb's.
    std::string name;
    for (std::size_t at = 0; at < usage.size() && std::islower(static_cast<unsigned char>(usage[at])) != 0;) {
        const std::size_t end = std::min(usage.find(' ', at), usage.size());
        name += (name.empty() ? "" : "-") + usage.substr(at, end - at);
        at = end + 1;
    }
    std::string page = heading(name) + ".SH NAME\n" + escaped(name) + " \\- " +
                       escaped(first_sentence(explanation)) + "\n.SH SYNOPSIS\n.B " + escaped(usage) +
                       "\n.SH DESCRIPTION\n" + paragraphs(explanation) + ".SH OPTIONS\n";
    for (const auto& option : options.options()) page += option_text(*option);
    return page + k_exit_status + ".SH SEE ALSO\n.BR candela (1)\n";
}

std::string manual_page(std::span<const Verb> verbs) {
    std::string page =
        heading("candela") +
        ".SH NAME\ncandela \\- render scenes with lighting models that are plugins\n"
        ".SH SYNOPSIS\n.B candela\n.I VERB\n.RI [ arguments ]\n.SH DESCRIPTION\n"
        "Candela renders scenes whose lights, shapes, shading and reflection models are plugins.\n"
        "Each verb has a page of its own, such as\n.BR candela\\-render (1).\n"
        ".SH VERBS\n";
    for (const Verb& verb : verbs)
        page += ".TP\n.B " + escaped(verb.name) + '\n' + escaped(verb.summary) + '\n';
    return page +
           ".SH ENVIRONMENT\n"
           ".TP\n.B CANDELA_PLUGIN_PATH\nFolders of plugins, separated by colons. They are searched after "
           "those "
           "that\n"
           ".B \\-\\-plugin\\-dir\nnames.\n"
           ".TP\n.B CANDELA_INSTRUCTION_SET\nbaseline, avx2 or avx512 instead of the best that the processor "
           "has.\n"
           ".TP\n.B NO_COLOR\nIf set, messages are not coloured.\n"
           ".TP\n.B COLUMNS\nThe width at which help and lists are wrapped.\n"
           ".SH FILES\n"
           ".TP\n.I ~/.local/share/candela/plugins\nYour own plugins\n.RI ( $XDG_DATA_HOME/candela/plugins\n"
           "if that is set).\n" +
           k_exit_status +
           ".SH EXAMPLES\n"
           ".TP\n.B candela new\nWrite a starter scene, scene.toml.\n"
           ".TP\n.B candela render scene.toml \\-o scene.png\nRender it.\n"
           ".TP\n.B candela view scene.toml\nShow it in the browser while you edit it.\n";
}
