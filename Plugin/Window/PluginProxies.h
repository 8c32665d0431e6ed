// SPDX-License-Identifier: BSD-3-Clause
// Distinguishes the filters of this plugin from others.
#pragma once

class vtkSMProxy;

namespace cactus
{

/// The submenu of this plugin in Sources and Filters.
constexpr char menuCategory[] = "CACTUS";

/// Tells whether a proxy is in that submenu, by the hint ShowInMenu in its XML. False for null.
bool isOfThisPlugin(vtkSMProxy* proxy);

} // namespace cactus
