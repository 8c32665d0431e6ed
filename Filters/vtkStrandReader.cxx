// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStrandReader.h"

#include "FibreData.h"
#include "FilterSupport.h"
#include "base/Error.h"
#include "io/StrandFile.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkStrandReader);

vtkStrandReader::vtkStrandReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkStrandReader::~vtkStrandReader()
{
  this->SetFileName(nullptr);
}

int vtkStrandReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      if (this->FileName == nullptr || *this->FileName == '\0')
      {
        throw cactus::InvalidInput("FileName is empty: name the strand file to read");
      }
      auto* output = vtkPolyData::GetData(outputs);
      cactus::toPolyData(cactus::readStrandFile(this->FileName), output);
      cactus::addProvenance(nullptr, output, "StrandReader", std::string("FileName=") + this->FileName);
    });
}

void vtkStrandReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n';
}
