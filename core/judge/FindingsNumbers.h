// SPDX-License-Identifier: BSD-3-Clause
// The findings of one process on a fibre, as bytes for another one.
#pragma once

#include "judge/CertificateFindings.h"
#include "mesh/BoxTree.h"

#include <string>
#include <vector>

namespace cactus
{

/// Returns the findings, the distance by which the fibre reaches out of the domain (µm), and the boxes of its outer surface's
/// parts.
std::string bytesOf(const FibreCertificate& fibre, double reach, const std::vector<FloatBox>& branches);

/// Reads them back. Throws FileError for other bytes.
void getFindings(const std::string& bytes, FibreCertificate& fibre, double& reach, std::vector<FloatBox>& branches);

} // namespace cactus
