// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// The fibres with these numbers, in their order, with all that is known of them, in the same domain.
Fibres selectFibres(const Fibres& fibres, const std::vector<std::size_t>& which);

/// The numbers of all of them by increasing id.
std::vector<std::size_t> orderById(const Fibres& fibres);

} // namespace cactus
