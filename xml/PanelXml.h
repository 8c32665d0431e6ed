// SPDX-License-Identifier: BSD-3-Clause
// ParaView's XML of the stages' panels, from xml/*.xml and the one description of each property.
#pragma once

#include "stages/Stages.h"

#include <string>
#include <vector>

namespace cactus
{

/// Returns `text`, a file of xml/, with a whole property element in place of each `<StageProperty name="NAME"/>`: type, command,
/// default, domains, help and the decorators that hide it while it has no effect. One within a PropertyGroup comes before the
/// group, which refers to it. Attributes and children of a StageProperty are kept, except `slider="1"`, which gives a number a
/// slider over its range instead of a plain field. Throws InvalidInput for a property that the stage of the proxy's class does
/// not have, for one that stands there twice, and for one of the stage that the proxy of the stage's name lacks.
std::string panelXml(const std::string& text, const std::vector<StageDescription>& stages);

} // namespace cactus
