#include "errors.h"

#include "console/diagnostics_text.h"
#include "module.h"

import candela.plugins;

namespace candela::python {

namespace {

std::string after_message(const Help& help) {
    switch (help.topic) {
        case Help::Topic::all_plugins:
            return "; candela.models() lists all";
        case Help::Topic::plugin_conformance:
            return "; the command 'candela plugin test' shows details";
        default:
            return {};
    }
}

std::string hint(const Help& help) {
    switch (help.topic) {
        case Help::Topic::plugin:
            return fmt::format("(candela.model('{}'))", help.subject);
        case Help::Topic::plugins_of_kind:
            return fmt::format("(candela.models('{}'))", help.subject);
        case Help::Topic::default_models:
            return fmt::format("defaults=True uses {}; shading= and reflection= name others", help.subject);
        default:
            return {};
    }
}

constexpr HelpWords k_help_in_python{.after_message = after_message, .hint = hint};

std::string text_of(const Diagnostics& diagnostics) {
    std::string text =
        diagnostics_text(diagnostics, false, k_most_diagnostics_shown, Shown::errors, k_help_in_python);
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

/// Raises an exception of the package's own, with its diagnostics.
void raise(const char* type, const std::string& message, const std::vector<Problem>& problems) {
    const py::object exception = py::module_::import("candela.errors").attr(type)(message, problems);
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
}

const char* type_of(ErrorCategory category) {
    switch (category) {
        case ErrorCategory::bad_request:
            return "RequestError";
        case ErrorCategory::invalid_scene:
            return "SceneError";
        default:
            return "Error";
    }
}

}  // namespace

std::vector<Problem> problems_of(const Diagnostics& diagnostics) {
    std::vector<Problem> problems;
    for (const Diagnostic& found : diagnostics.sorted()) {
        problems.push_back({.severity = found.severity == Severity::error ? "error" : "warning",
                            .file = found.place.file,
                            .line = found.place.line,
                            .column = found.place.column,
                            .length = found.place.length,
                            .message = full_message(found.message, found.help, k_help_in_python),
                            .suggestion = full_hint(found, k_help_in_python),
                            .text = diagnostics.source_line(found.place).value_or("")});
    }
    return problems;
}

InvalidInput::InvalidInput(What what, const Diagnostics& diagnostics)
    : std::runtime_error(text_of(diagnostics)), what_(what), problems_(problems_of(diagnostics)) {}

std::string python_message(const Error& error) {
    return full_message(error.what(), error.help(), k_help_in_python);
}

void add_errors(py::module_& module) {
    py::class_<Problem>(module, "Problem", "A problem and its position; the source of candela.Diagnostic.")
        .def_readonly("severity", &Problem::severity)
        .def_readonly("file", &Problem::file)
        .def_readonly("line", &Problem::line)
        .def_readonly("column", &Problem::column)
        .def_readonly("length", &Problem::length)
        .def_readonly("message", &Problem::message)
        .def_readonly("suggestion", &Problem::suggestion)
        .def_readonly("text", &Problem::text);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const InvalidInput& wrong) {
            raise(wrong.what_is_wrong() == InvalidInput::What::scene ? "SceneError" : "RequestError",
                  wrong.what(), wrong.problems());
        } catch (const KernelError& error) {
            // A text of the program, or a file that it names: a scene's are among its diagnostics.
            Diagnostics diagnostics;
            error.report_in(diagnostics);
            raise("RequestError", error.what(), problems_of(diagnostics));
        } catch (const Error& error) {
            raise(type_of(error.category()), python_message(error), {});
        }
    });
}

}  // namespace candela::python
