// SPDX-License-Identifier: BSD-3-Clause
#include "ChartButton.h"

#include "AfterUpdate.h"
#include "ProgressBar.h"

#include <pqObjectBuilder.h>
#include <pqOutputPort.h>
#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqView.h>
#include <vtkNew.h>
#include <vtkSMParaViewPipelineControllerWithRendering.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMViewProxy.h>

#include <QStatusBar>
#include <QToolButton>

#include <cstring>

namespace cactus
{
namespace
{

constexpr char chartView[] = "ConvergenceChartView"; ///< in xml/views/Convergence.xml
constexpr int convergence = 1;                       ///< output of CapsuleOptimizer

} // namespace

ChartButton::ChartButton(pqPVApplicationCore* core)
  : QObject(core)
{
  QStatusBar* bar = statusBar();
  if (bar == nullptr)
  {
    return; // an application of another kind
  }
  this->Button = new QToolButton(bar);
  this->Button->setObjectName("CactusChart");
  this->Button->setText("Convergence");
  this->Button->setToolTip("Charts overlap and overlapping pairs by iteration, in a view beside this one.");
  this->Button->hide();
  bar->addWidget(this->Button);
  QObject::connect(this->Button, &QToolButton::clicked, this, &ChartButton::chart);
  afterUpdate(core, this,
    [this](pqPipelineSource* source)
    {
      if (this->Optimiser != source && std::strcmp(source->getProxy()->GetXMLName(), "CapsuleOptimizer") == 0)
      {
        this->Optimiser = source;
        this->Button->show();
        QObject::connect(source, &QObject::destroyed, this,
          [this]
          {
            if (this->Button != nullptr) // the window may go before
            {
              this->Button->setVisible(this->Optimiser != nullptr);
            }
          });
      }
    });
}

void ChartButton::chart()
{
  if (this->Optimiser == nullptr)
  {
    return;
  }
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  pqView* chart = nullptr;
  for (pqView* view : this->Optimiser->getOutputPort(convergence)->getViews())
  {
    chart = view->getViewType() == chartView ? view : chart;
  }
  if (chart == nullptr)
  {
    chart = pqApplicationCore::instance()->getObjectBuilder()->createView(chartView, this->Optimiser->getServer());
    controller->AssignViewToLayout(chart->getViewProxy());
  }
  controller->Show(this->Optimiser->getSourceProxy(), convergence, chart->getViewProxy());
  chart->render();
}

} // namespace cactus
