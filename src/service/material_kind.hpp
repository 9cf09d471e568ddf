// A derived material is of the kind that its variable has, and has the attributes of that, too.
#pragma once

#include <vector>

#include "lang/objects.hpp"
#include "service/program.hpp"

namespace crt::service {

/// Returns the type of the material that an expression makes, which variables may stand for, or
/// null. It is Material or PrincipledMaterial.
const lang::ObjectType* material_type(const Program& program, const lang::Expression& expression);

/// Lists the attributes that a derived material has from its variable: those that are given there,
/// or in what that is derived from, and not in it.
std::vector<const lang::AttributeSyntax*> inherited_attributes(
    const Program& program, const lang::DerivedMaterial& material);

}  // namespace crt::service
