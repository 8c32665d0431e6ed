// SPDX-License-Identifier: BSD-3-Clause
// Distinguishes the filters of this plugin from others, and finds their panels and the window.
#pragma once

class QMainWindow;
class QWidget;
class pqProxyWidget;
class vtkSMProxy;

namespace cactus
{

/// The submenu of this plugin in Sources and Filters.
constexpr char menuCategory[] = "CACTUS";

/// Tells whether a proxy is in that submenu, by the hint ShowInMenu in its XML. False for null.
bool isOfThisPlugin(vtkSMProxy* proxy);

/// Returns the panel of a proxy that a widget is in; null if it is in none.
const pqProxyWidget* panelAround(const QWidget* widget);

/// Returns ParaView's window; null in an application of another kind.
QMainWindow* mainWindow();

} // namespace cactus
