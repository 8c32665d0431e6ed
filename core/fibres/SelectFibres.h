// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// Returns the fibres with these indices, in this order, with all their data and the same domain.
Fibres selectFibres(const Fibres& fibres, const std::vector<std::size_t>& which);

/// Returns the indices of all fibres by increasing FibreId.
std::vector<std::size_t> orderById(const Fibres& fibres);

} // namespace cactus
