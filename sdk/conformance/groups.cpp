#include "groups.h"

#include <algorithm>
#include <catch2/catch_session.hpp>
#include <catch2/catch_test_case_info.hpp>
#include <catch2/interfaces/catch_interfaces_registry_hub.hpp>
#include <catch2/interfaces/catch_interfaces_testcase.hpp>
#include <catch2/reporters/catch_reporter_event_listener.hpp>
#include <catch2/reporters/catch_reporter_registrars.hpp>
#include <string>

namespace {

Findings* receiver = nullptr;

/// Passes on Catch2's findings.
class Listener final : public Catch::EventListenerBase {
  public:
    using Catch::EventListenerBase::EventListenerBase;

    void assertionEnded(const Catch::AssertionStats& stats) override {
        const Catch::AssertionResult& result = stats.assertionResult;
        const std::string message =
            result.hasMessage() ? std::string(result.getMessage()) : result.getExpandedExpression();
        switch (result.getResultType()) {
            case Catch::ResultWas::Ok:
            case Catch::ResultWas::Info:
                return;
            case Catch::ResultWas::Warning:
                return receiver->add("warning", message);
            case Catch::ResultWas::ExplicitSkip:
                return receiver->add("skipped", message);
            case Catch::ResultWas::FatalErrorCondition:
                return;  // the signal is reported instead
            default:
                return receiver->add("failed", message);
        }
    }
};

CATCH_REGISTER_LISTENER(Listener)

bool has_tag(const Catch::TestCaseInfo& group, const std::string& tag) {
    return std::ranges::any_of(group.tags, [&](const Catch::Tag& t) { return t.original == tag; });
}

}  // namespace

std::vector<std::string> groups_for(const std::string& kind) {
    std::vector<const Catch::TestCaseInfo*> found;
    for (Catch::TestCaseInfo* const group : Catch::getRegistryHub().getTestCaseRegistry().getAllInfos()) {
        if (has_tag(*group, "all") || has_tag(*group, kind)) found.push_back(group);
    }
    // The checks for every plugin come first: the rest depends on them.
    std::ranges::sort(found, [](const auto* a, const auto* b) {
        const bool a_is_for_all = has_tag(*a, "all"), b_is_for_all = has_tag(*b, "all");
        return a_is_for_all != b_is_for_all ? a_is_for_all : a->lineInfo < b->lineInfo;
    });
    std::vector<std::string> names;
    for (const Catch::TestCaseInfo* group : found) names.push_back(group->name);
    return names;
}

void run_group(const std::string& group, Findings& findings) {
    receiver = &findings;
    static Catch::Session session;  // a process may have only one
    Catch::ConfigData config;
    std::string escaped;
    for (const char c : group)
        escaped +=
            (c == ',' || c == '[' || c == '"' || c == '\\') ? std::string("\\") + c : std::string(1, c);
    config.testsOrTags = {escaped};
    config.rngSeed = 1;
    config.defaultOutputFilename = "/dev/null";  // findings are reported in another way
    session.useConfigData(config);
    session.run();
}
