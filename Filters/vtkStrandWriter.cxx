// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStrandWriter.h"

#include "FibreData.h"
#include "FilterSupport.h"
#include "WholeData.h"
#include "base/Error.h"
#include "io/StrandFile.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkStrandWriter);

vtkStrandWriter::~vtkStrandWriter()
{
  this->SetFileName(nullptr);
}

int vtkStrandWriter::FillInputPortInformation(int, vtkInformation* info)
{
  cactus::acceptAnyData(info);
  return 1;
}

void vtkStrandWriter::WriteData()
{
  // On several ranks each gets all fibres, as a sink asks for the first piece of one; the first writes them.
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  if (controller != nullptr && controller->GetLocalProcessId() > 0)
  {
    return;
  }
  const bool isWritten = cactus::attempt(this,
    [&]
    {
      if (this->FileName == nullptr || *this->FileName == '\0')
      {
        throw cactus::InvalidInput("FileName is empty: name the strand file to write");
      }
      cactus::writeStrandFile(cactus::fibresFrom(this->GetInput()), this->FileName);
    });
  if (!isWritten)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
  }
}

void vtkStrandWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n';
}
