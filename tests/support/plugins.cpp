#include "support/plugins.h"

candela::Registry& test_registry() {
    static candela::Registry registry({CANDELA_TEST_PLUGINS});
    return registry;
}

std::vector<candela::InstructionSet> machine_instruction_sets() {
    std::vector<candela::InstructionSet> sets;
    for (const candela::InstructionSet set : candela::k_instruction_sets) {
        if (set <= candela::best_instruction_set()) sets.push_back(set);
    }
    return sets;
}
