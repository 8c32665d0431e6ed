// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QList>
#include <QObject>
#include <QPointer>

class pqPVApplicationCore;
class pqPipelineSource;

namespace cactus
{

/// Lets ParaView's filters, such as Clip, Slice and Threshold, take the place of fibres and surfaces in a view, with their look.
///
/// At its first Apply, ParaView hides the input of such a filter only if that is drawn as Surface, and gives the result its own
/// grey. Here the input is hidden also if it is drawn by one of our representations, and the result gets its colour and opacity,
/// unless an array colours it. Where one of our filters takes the place of outer surfaces, the inner ones beside them are hidden,
/// too, and an image that it makes gets colours.
class InheritedLook : public QObject
{
public:
  explicit InheritedLook(pqPVApplicationCore* core);

private:
  void afterApply();

  QList<QPointer<pqPipelineSource>> Created; ///< filters that have not been applied yet
};

} // namespace cactus
