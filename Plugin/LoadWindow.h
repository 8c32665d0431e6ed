// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cactus
{

/// Where this process is ParaView's window, loads what the plugin adds to it (Window/), from beside the plugin. Else does
/// nothing.
void loadWindow();

} // namespace cactus
