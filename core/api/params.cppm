module;

#include "candela/plugin/params.h"

export module candela.params;

export namespace candela {
using candela::k_no_maximum;
using candela::k_no_minimum;
using candela::name_of;
using candela::NumberList;
using candela::ParamSpec;
using candela::ParamType;
using candela::ParamValue;
using candela::PresetSpec;
using candela::PresetValue;
using candela::RelationSpec;
using candela::RelationType;
}  // namespace candela
