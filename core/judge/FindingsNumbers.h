// SPDX-License-Identifier: BSD-3-Clause
// What one process has found on a fibre, as bytes for another one.
#pragma once

#include "judge/CertificateFindings.h"
#include "mesh/BoxTree.h"

#include <string>
#include <vector>

namespace cactus
{

/// With how far it reaches out of the domain (µm), and the boxes of its outer surface's parts.
std::string bytesOf(const FibreCertificate& fibre, double reach, const std::vector<FloatBox>& branches);

/// The reverse. Throws FileError for bytes that are something else.
void getFindings(const std::string& bytes, FibreCertificate& fibre, double& reach, std::vector<FloatBox>& branches);

} // namespace cactus
