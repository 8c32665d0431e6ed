// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class pqProgressWidget;

namespace cactus
{

/// Returns the progress bar in the status bar of ParaView's window; null in an application without one.
pqProgressWidget* progressBar();

} // namespace cactus
