// SPDX-License-Identifier: BSD-3-Clause
#include "CodeChoices.h"

#include "PluginProxies.h"

#include <pqPropertyWidget.h>
#include <vtkPVXMLElement.h>
#include <vtkSMProperty.h>
#include <vtkSMProxy.h>
#include <vtkSMUncheckedPropertyHelper.h>

#include <QBoxLayout>
#include <QComboBox>
#include <QLineEdit>
#include <QSignalBlocker>

namespace cactus
{
namespace
{

/// The choice beside the line of a property's number.
class CodeChoice : public QComboBox
{
public:
  CodeChoice(pqPropertyWidget* widget, QLineEdit* line, vtkPVXMLElement* code)
    : QComboBox(widget)
    , Widget(widget)
    , Line(line)
    , Code(QString(code->GetAttribute("value")).toDouble())
    , Other(QString(code->GetAttribute("otherwise")).toDouble())
  {
    this->setObjectName("Choice");
    this->addItems({ code->GetAttribute("text"), "value:" });
    this->setToolTip(widget->toolTip());
    QObject::connect(this, QOverload<int>::of(&QComboBox::currentIndexChanged), widget,
      [this](int entry) { this->give(entry == codeEntry ? this->Code : this->Other); });
    // While somebody types, a number that only begins like the code does not hide the line.
    QObject::connect(line, &QLineEdit::textChanged, this,
      [this]
      {
        if (!this->Line->hasFocus())
        {
          this->follow();
        }
      });
    QObject::connect(line, &QLineEdit::editingFinished, this, [this] { this->follow(); });
    this->follow();
  }

private:
  static constexpr int codeEntry = 0;

  /// Shows what the line says.
  void follow()
  {
    const double value = this->Line->text().toDouble();
    const bool isCode = value == this->Code;
    if (!isCode)
    {
      this->Other = value;
    }
    const QSignalBlocker blocker(this);
    this->setCurrentIndex(isCode ? codeEntry : codeEntry + 1);
    this->Line->setVisible(!isCode);
  }

  /// Gives the property a value, as if somebody had typed it.
  void give(double value)
  {
    vtkSMUncheckedPropertyHelper(this->Widget->property()).Set(value);
    this->follow();
    Q_EMIT this->Widget->changeAvailable();
    Q_EMIT this->Widget->changeFinished();
  }

  pqPropertyWidget* Widget;
  QLineEdit* Line;
  double Code;
  double Other; ///< the last value that was not the code
};

} // namespace

CodeChoices::CodeChoices(QObject* parent)
  : QObject(parent)
{
}

void CodeChoices::createDefaultWidgetDecorators(pqPropertyWidget* widget)
{
  if (!isOfThisPlugin(widget->proxy()) || widget->property() == nullptr)
  {
    return;
  }
  vtkPVXMLElement* hints = widget->property()->GetHints();
  vtkPVXMLElement* code = hints != nullptr ? hints->FindNestedElementByName("Code") : nullptr;
  QLineEdit* line = widget->findChild<QLineEdit*>();
  QBoxLayout* row = qobject_cast<QBoxLayout*>(widget->layout());
  if (code != nullptr && line != nullptr && row != nullptr)
  {
    row->insertWidget(0, new CodeChoice(widget, line, code), 1);
  }
}

} // namespace cactus
