// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cactus
{

/// In ParaView's window, loads the plugin's window part (Plugin/Window/) from the plugin's folder; does nothing elsewhere.
void loadWindow();

} // namespace cactus
