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
#include <QDesktopServices>
#include <QDialog>
#include <QFile>
#include <QImage>
#include <QMainWindow>
#include <QMenu>
#include <QPushButton>
#include <QTextBlock>
#include <QTextBrowser>
#include <QUrl>
#include <QVBoxLayout>

namespace cactus
{
namespace
{

/// Shows pages of the handbook, which Qt reads as Markdown, without their pictures. Links to what is no page do nothing.
class Pages : public QTextBrowser
{
public:
  explicit Pages(QWidget* parent)
    : QTextBrowser(parent)
  {
    this->setOpenLinks(false);
    QObject::connect(this, &QTextBrowser::anchorClicked, this, [this](const QUrl& link) { this->open(link); });
  }

  QVariant loadResource(int type, const QUrl& name) override
  {
    return type == QTextDocument::ImageResource ? QVariant(QImage(1, 1, QImage::Format_Mono))
                                                : QTextBrowser::loadResource(type, name);
  }

private:
  void open(const QUrl& link)
  {
    if (link.scheme() == "http" || link.scheme() == "https")
    {
      QDesktopServices::openUrl(link);
    }
    else if (const QUrl page = this->source().resolved(link.adjusted(QUrl::RemoveFragment)); QFile::exists(":" + page.path()))
    {
      this->setSource(page);
    }
  }
};

QMenu* helpMenu()
{
  QMainWindow* window = mainWindow();
  return window != nullptr ? window->findChild<QMenu*>("menu_Help") : nullptr;
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
    QDialog* dialog = new QDialog(mainWindow());
    dialog->setObjectName("CactusHandbook");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->resize(900, 700);
    Pages* pages = new Pages(dialog);
    pages->setObjectName("Pages");
    QPushButton* back = new QPushButton("Back", dialog);
    back->setEnabled(false);
    QObject::connect(back, &QPushButton::clicked, pages, &QTextBrowser::backward);
    QObject::connect(pages, &QTextBrowser::backwardAvailable, back, &QPushButton::setEnabled);
    QObject::connect(pages, &QTextBrowser::sourceChanged, dialog,
      [dialog, pages] { dialog->setWindowTitle("CACTUS: " + pages->document()->firstBlock().text()); });
    QVBoxLayout* column = new QVBoxLayout(dialog);
    column->addWidget(back, 0, Qt::AlignLeft);
    column->addWidget(pages);
    pages->setSource(QUrl("qrc:/cactus/docs/tutorial.md"));
    this->Handbook = dialog;
  }
  this->Handbook->show();
  this->Handbook->raise();
}

} // namespace cactus
