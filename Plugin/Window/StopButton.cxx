// SPDX-License-Identifier: BSD-3-Clause
#include "StopButton.h"

#include "PluginProxies.h"
#include "ProgressBar.h"

#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqProgressManager.h>
#include <pqProgressWidget.h>
#include <pqServerManagerModel.h>
#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkSMProxy.h>

#include <QApplication>
#include <QCursor>
#include <QEvent>
#include <QPoint>
#include <QTimer>
#include <QToolButton>
#include <QWidget>
#include <QWindow>

namespace cactus
{
namespace
{

constexpr int pauseBetweenClicks = 100; // ms
constexpr int takingClicks = 30;        // ms; without a time Qt serves one event only, which may be another

} // namespace

StopButton::StopButton(pqPVApplicationCore* core)
  : QObject(core)
  , Bar(progressBar())
{
  if (this->Bar == nullptr)
  {
    return; // an application of another kind
  }
  this->Button = this->Bar->abortButton();
  QObject::connect(this->Button, &QToolButton::pressed, this,
    [this]
    {
      if (this->Running != nullptr)
      {
        this->Running->SetAbortExecute(1);
      }
    });
  pqServerManagerModel* model = core->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    this->watch(source);
  }
  QObject::connect(model, &pqServerManagerModel::sourceAdded, this, &StopButton::watch);
}

void StopButton::watch(pqPipelineSource* source)
{
  // What runs on a server elsewhere is not in this process.
  auto* algorithm =
    isOfThisPlugin(source->getProxy()) ? vtkAlgorithm::SafeDownCast(source->getProxy()->GetClientSideObject()) : nullptr;
  if (algorithm != nullptr)
  {
    algorithm->AddObserver(vtkCommand::ProgressEvent, this, &StopButton::takeClicks);
    algorithm->AddObserver(vtkCommand::EndEvent, this, &StopButton::end);
  }
}

void StopButton::takeClicks(vtkObject* algorithm, unsigned long, void*)
{
  if (this->IsTaking || this->Bar == nullptr || (this->SinceClicks.isValid() && this->SinceClicks.elapsed() < pauseBetweenClicks))
  {
    return;
  }
  this->Running = vtkAlgorithm::SafeDownCast(algorithm);
  if (!this->Button->isEnabled())
  {
    this->Button->setEnabled(true);
    this->Button->repaint();
  }
  if (this->IsToClose)
  {
    this->Running->SetAbortExecute(1);
  }
  const QPoint mouse = QCursor::pos();
  const QWidget* window = this->Bar->window();
  const bool isOutside = !window->rect().contains(window->mapFromGlobal(mouse)); // perhaps at the button that closes the window
  if (isOutside || this->Bar->rect().contains(this->Bar->mapFromGlobal(mouse)))
  {
    this->IsTaking = true;
    pqProgressManager* manager = pqPVApplicationCore::instance()->getProgressManager();
    const bool wasUnblocked = manager->unblockEvents(true);
    QCoreApplication::instance()->installEventFilter(this);
    QCoreApplication::processEvents(QEventLoop::AllEvents, takingClicks);
    QCoreApplication::instance()->removeEventFilter(this);
    manager->unblockEvents(wasUnblocked);
    this->IsTaking = false;
  }
  this->SinceClicks.start();
}

void StopButton::end(vtkObject*, unsigned long, void*)
{
  this->Running = nullptr;
  if (this->Button != nullptr)
  {
    this->Button->setEnabled(false);
  }
  for (const QPointer<QWidget>& view : this->ToPaint)
  {
    if (view != nullptr)
    {
      view->update();
    }
  }
  this->ToPaint.clear();
}

void StopButton::closeSoon()
{
  QTimer::singleShot(pauseBetweenClicks, this,
    [this]
    {
      if (this->Running != nullptr)
      {
        this->closeSoon();
        return;
      }
      this->IsToClose = false;
      this->Bar->window()->close();
    });
}

bool StopButton::eventFilter(QObject* object, QEvent* event)
{
  switch (event->type())
  {
  case QEvent::MouseButtonPress:
  case QEvent::MouseButtonRelease:
  case QEvent::MouseButtonDblClick:
  case QEvent::MouseMove:
    // The window's own object gets them before the widget does.
    return object->isWidgetType() && object != this->Button;
  case QEvent::Paint:
    // A view would update the pipeline, which is running.
    if (object->inherits("QOpenGLWidget"))
    {
      this->ToPaint.append(qobject_cast<QWidget*>(object));
      return true;
    }
    return false;
  case QEvent::Close:
    event->ignore();
    // The system's window gets it first.
    if (this->Bar != nullptr && (object == this->Bar->window() || object == this->Bar->window()->windowHandle()) &&
        !this->IsToClose)
    {
      this->IsToClose = true;
      this->Running->SetAbortExecute(1);
      this->closeSoon();
    }
    return true;
  case QEvent::Drop:
    event->ignore();
    return true;
  case QEvent::Timer: // rings again
  case QEvent::Wheel:
  case QEvent::KeyPress:
  case QEvent::KeyRelease:
  case QEvent::Shortcut:
  case QEvent::ShortcutOverride:
  case QEvent::ContextMenu:
  case QEvent::TouchBegin:
  case QEvent::TouchUpdate:
  case QEvent::TouchEnd:
  case QEvent::DragEnter:
    return true;
  default:
    return false;
  }
}

} // namespace cactus
