// SPDX-License-Identifier: BSD-3-Clause
// Telling the filters of this plugin from others.
#pragma once

class vtkSMProxy;

namespace cactus
{

/// The submenu of Sources and Filters that this plugin's have.
constexpr char menuCategory[] = "CACTUS";

/// Whether a proxy is in that submenu, by the hint ShowInMenu in its XML. False of null.
bool isOfThisPlugin(vtkSMProxy* proxy);

} // namespace cactus
