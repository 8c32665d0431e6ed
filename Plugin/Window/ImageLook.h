// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqPVApplicationCore;
class pqPipelineSource;

namespace cactus
{

/// The colours in which images of a new filter of this plugin are seen first: depth with white at 0, the outer surface of the
/// fibres, in a box whose axes are in µm; masks in their greys. White stays at 0 when the depth's range changes, until the user
/// chooses other colours. What a state or a script shows is left alone.
class ImageLook : public QObject
{
public:
  explicit ImageLook(pqPVApplicationCore* core);

private:
  static void apply(pqPipelineSource* source);
};

} // namespace cactus
