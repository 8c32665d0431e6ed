// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "surface/DepthsAlong.h"
#include "surface/FibreLine.h"
#include "surface/MyelinSurfaceOptions.h"
#include "surface/NodesOfRanvier.h"
#include "surface/SmoothedField.h"

#include <cstddef>
#include <optional>

namespace cactus
{

/// How the surfaces of one fibre depend on the place along its centre line (see MyelinSurfaceOptions).
///
/// Contours of one level become surfaces of varying depth by lowering the field, at each sample by a depth for its place along
/// the line. Where a fibre has all of its myelin, its outer surface lies where it would without a profile; elsewhere, in nodes
/// and where a lesion has taken myelin, fields are only ever lowered for it. So the fields of two fibres still sum to at most
/// -gap, and outer surfaces keep it.
class MyelinProfile
{
public:
  /// The fibre is number `fibre` of those that have grown, and has lost this fraction of its internodes. The field has to outlive
  /// the object.
  MyelinProfile(const SmoothedField& field, const Fibres& fibres, std::size_t fibre, const MyelinSurfaceOptions& options,
    double internodeLoss);

  MyelinProfile(const MyelinProfile&) = delete;
  MyelinProfile& operator=(const MyelinProfile&) = delete;

  /// Returns the field whose contour at one level is the axon with this part of the volume above `outer` (µm), if the fibre had
  /// no nodes: about at the level of that contour in the field given. Each cross-section has the same part of its area, if the
  /// options ask for that, and more of it in swellings, less between them. No myelin is thinner than `thinnest`, and
  /// swellings leave about `wall` (µm) of it.
  SmoothedField shaped(double part, double outer, double thinnest, double wall);
  /// Returns by how much (µm) swellings are at most nearer to the fibre's surface than the axon's level after shaped().
  double raised() const { return this->Raised; }

  /// Tells whether the fibre lacks myelin somewhere: at a node, or by a lesion.
  bool lacksMyelin() const { return this->Lacks; }
  /// Gives a fibre without an axon, to which it could not come down, all of its myelin.
  void forgetLack() { this->Lacks = false; }
  /// Returns the number of nodes whose middle lies in the box, and the length (µm) of an internode; 0 without nodes.
  int nodeCount() const;
  double internodeLength() const;
  /// Puts the axon at this level of the field (shaped(), if that was called), and the myelin's thickness where it lacks at `wall`
  /// (µm). `gRatio` is that of whole internodes.
  void takeMyelin(double level, double wall, double gRatio);
  /// Returns the fields after takeMyelin(): for the outer surface at the levels as with all myelin, and for the axon at `level`.
  const SmoothedField& outer() const { return *this->Outer; }
  const SmoothedField& inner() const { return *this->Inner; }
  double level() const { return this->Level; }

private:
  AlongLine swollen(const AlongLine& depth, double shallowest) const;

  const SmoothedField& Field;
  const MyelinSurfaceOptions& Options;
  int FibreId;
  FibreLine Line;
  DepthsAlong Depths;
  AlongLine Deeper;                    ///< µm by which the axon lies deeper than its level, without nodes; empty: nowhere
  std::optional<NodesOfRanvier> Nodes; ///< those that reach into the fibre
  double Raised = 0.0;
  bool Lacks = false;
  std::optional<SmoothedField> Outer;
  std::optional<SmoothedField> Inner;
  double Level = 0.0; ///< µm
};

} // namespace cactus
