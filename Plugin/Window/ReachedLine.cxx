// SPDX-License-Identifier: BSD-3-Clause
#include "ReachedLine.h"

#include "AfterUpdate.h"
#include "ProgressBar.h"

#include <pqOutputPort.h>
#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <vtkDataObject.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkSMProxy.h>

#include <QLabel>
#include <QStatusBar>
#include <QString>
#include <QTimer>

#include <algorithm>
#include <optional>

namespace cactus
{
namespace
{

vtkPVArrayInformation* arrayOf(pqPipelineSource* source, int port, int association, const char* name)
{
  return source->getOutputPort(port)->getDataInformation()->GetArrayInformation(name, association);
}

/// Returns the largest value of an array with numbers, which is the value itself if it has only one; nothing without them.
std::optional<double> largest(pqPipelineSource* source, int port, int association, const char* name)
{
  vtkPVArrayInformation* array = arrayOf(source, port, association, name);
  if (array == nullptr || array->GetNumberOfTuples() == 0)
  {
    return std::nullopt;
  }
  const double* range = array->GetComponentRange(0);
  return range[0] <= range[1] ? std::optional<double>(range[1]) : std::nullopt;
}

QString number(double value)
{
  return QString::number(value, 'g', 3);
}

QString counted(qint64 count, const char* one, const char* many)
{
  return QString("%1 %2").arg(count).arg(count == 1 ? one : many);
}

QString packed(pqPipelineSource* source)
{
  return counted(source->getOutputPort(0)->getDataInformation()->GetNumberOfCells(), "fibre", "fibres");
}

QString optimised(pqPipelineSource* source)
{
  const std::optional<double> converged = largest(source, 0, vtkDataObject::FIELD, "Converged");
  const std::optional<double> penetration = largest(source, 0, vtkDataObject::FIELD, "MaximumPenetration");
  const std::optional<double> iterations = largest(source, 1, vtkDataObject::ROW, "Iteration");
  if (!converged || !penetration || !iterations)
  {
    return {};
  }
  return packed(source) + (*converged != 0.0 ? ", no overlap, " : ", overlap of up to " + number(*penetration) + ", ") +
         counted(static_cast<qint64>(*iterations), "iteration", "iterations");
}

QString grown(pqPipelineSource* source)
{
  vtkPVArrayInformation* fibres = arrayOf(source, 0, vtkDataObject::FIELD, "FibreTable.FibreId");
  const std::optional<double> growth = largest(source, 0, vtkDataObject::FIELD, "Growth");
  if (fibres == nullptr || !growth)
  {
    return {};
  }
  const std::optional<double> fraction = largest(source, 0, vtkDataObject::FIELD, "FibreVolumeFraction");
  return counted(fibres->GetNumberOfTuples(), "fibre", "fibres") + (fraction ? ", FVF " + number(*fraction) : QString()) +
         ", grown by " + number(*growth) + QString::fromUtf8(" µm");
}

QString meshed(pqPipelineSource* source)
{
  const std::optional<double> flawed = largest(source, 2, vtkDataObject::ROW, "Flawed");
  if (!flawed)
  {
    return {};
  }
  QString line = counted(source->getOutputPort(2)->getDataInformation()->GetNumberOfRows(), "fibre", "fibres");
  for (const char* fraction : { "FVF", "AVF" })
  {
    if (const std::optional<double> reached = largest(source, 2, vtkDataObject::FIELD, fraction))
    {
      line += QString(", %1 %2").arg(fraction).arg(number(*reached));
    }
  }
  return line + (*flawed != 0.0 ? ", some surfaces flawed" : ", no surface flawed");
}

QString judged(pqPipelineSource* source)
{
  const std::optional<double> certified = largest(source, 0, vtkDataObject::ROW, "Certified");
  return !certified ? QString() : *certified != 0.0 ? QString("certified") : QString("not certified");
}

/// Returns what a source or filter reached; empty if it failed, or is none of those that have something to tell.
QString reachedBy(pqPipelineSource* source)
{
  const QString name = source->getProxy()->GetXMLName();
  if (arrayOf(source, 0, vtkDataObject::FIELD, "Error") != nullptr)
  {
    return {};
  }
  return name == "BundleInitializer" || name == "CurvedBundles" || name == "TractFibres" ? packed(source)
         : name == "CapsuleOptimizer"                                                    ? optimised(source)
         : name == "FibreRadialGrowth"                                                   ? grown(source)
         : name == "MyelinSurface"                                                       ? meshed(source)
         : name == "SubstrateCertificate"                                                ? judged(source)
                                                                                         : QString();
}

/// Tells whether a source or filter feeds another, through others perhaps.
bool feeds(pqPipelineSource* source, const pqPipelineSource* other)
{
  const QList<pqPipelineSource*> consumers = source->getAllConsumers();
  return std::any_of(consumers.begin(), consumers.end(),
    [other](pqPipelineSource* consumer) { return consumer == other || feeds(consumer, other); });
}

} // namespace

ReachedLine::ReachedLine(pqPVApplicationCore* core)
  : QObject(core)
{
  QStatusBar* bar = statusBar();
  if (bar == nullptr)
  {
    return; // an application of another kind
  }
  this->Line = new QLabel(bar);
  this->Line->setObjectName("CactusReached");
  // As wide as its text, and less where the progress bar needs the room.
  this->Line->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Preferred);
  this->Line->setMinimumWidth(1);
  bar->addWidget(this->Line);
  afterUpdate(core, this,
    [this](pqPipelineSource* source)
    {
      // One Apply may update several, in any order: the last one of the chain has the say.
      if (this->Told != nullptr && feeds(source, this->Told))
      {
        return;
      }
      this->Told = source;
      QTimer::singleShot(0, this, [this] { this->Told = nullptr; });
      const QString reached = reachedBy(source);
      this->Line->setText(reached.isEmpty() ? QString() : source->getSMName() + ": " + reached);
      this->Line->setToolTip(this->Line->text());
    });
}

} // namespace cactus
