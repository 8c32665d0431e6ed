// SPDX-License-Identifier: BSD-3-Clause
#include "HelpMenu.h"

#include "ChainButton.h"
#include "PluginProxies.h"

#include <pqPVApplicationCore.h>
#include <vtkSMEnumerationDomain.h>
#include <vtkSMProperty.h>
#include <vtkSMProxy.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSessionProxyManager.h>

#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QImage>
#include <QMainWindow>
#include <QMenu>
#include <QTextBrowser>
#include <QUrl>
#include <QVBoxLayout>

namespace cactus
{
namespace
{

/// Shows pages of the handbook, which Qt reads as Markdown, without their pictures.
class Pages : public QTextBrowser
{
public:
  using QTextBrowser::QTextBrowser;

  QVariant loadResource(int type, const QUrl& name) override
  {
    return type == QTextDocument::ImageResource ? QVariant(QImage(1, 1, QImage::Format_Mono))
                                                : QTextBrowser::loadResource(type, name);
  }
};

QMenu* helpMenu()
{
  for (QWidget* widget : QApplication::topLevelWidgets())
  {
    if (QMenu* menu = qobject_cast<QMainWindow*>(widget) != nullptr ? widget->findChild<QMenu*>("menu_Help") : nullptr)
    {
      return menu;
    }
  }
  return nullptr; // an application of another kind
}

/// Fills a menu with an example for each preset.
void offerPresets(QMenu* examples)
{
  examples->clear();
  vtkSMSessionProxyManager* manager = vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager();
  vtkSMProxy* bundle = manager != nullptr ? manager->GetPrototypeProxy("sources", "BundleInitializer") : nullptr;
  auto* list = bundle != nullptr ? bundle->GetProperty("Preset")->FindDomain<vtkSMEnumerationDomain>() : nullptr;
  for (unsigned i = 1; list != nullptr && i < list->GetNumberOfEntries(); ++i) // the first is None
  {
    QObject::connect(examples->addAction(list->GetEntryText(i)), &QAction::triggered, examples,
      [preset = list->GetEntryValue(i)] { ChainButton::setUp(preset); });
  }
}

} // namespace

HelpMenu::HelpMenu(pqPVApplicationCore* core)
  : QObject(core)
{
  QMenu* menu = helpMenu();
  if (menu == nullptr)
  {
    return;
  }
  menu->addSeparator();
  QAction* tutorial = menu->addAction("CACTUS Tutorial");
  tutorial->setObjectName("CactusTutorial");
  QObject::connect(tutorial, &QAction::triggered, this, &HelpMenu::showTutorial);
  QMenu* examples = menu->addMenu("CACTUS Examples");
  examples->setObjectName("CactusExamples");
  QObject::connect(examples, &QMenu::aboutToShow, examples, [examples] { offerPresets(examples); });
}

void HelpMenu::showTutorial()
{
  if (this->Handbook == nullptr)
  {
    QDialog* dialog = new QDialog(helpMenu()->parentWidget()->window());
    dialog->setObjectName("CactusHandbook");
    dialog->setWindowTitle("CACTUS for ParaView");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->resize(900, 700);
    Pages* pages = new Pages(dialog);
    pages->setObjectName("Pages");
    pages->setOpenExternalLinks(true);
    pages->setSource(QUrl("qrc:/cactus/docs/tutorial.md"));
    (new QVBoxLayout(dialog))->addWidget(pages);
    this->Handbook = dialog;
  }
  this->Handbook->show();
  this->Handbook->raise();
}

} // namespace cactus
