// SPDX-License-Identifier: BSD-3-Clause
// The properties of a VTK class. Its stage's struct (core/stages/Stages.h) has their defaults, ranges and meanings.
#pragma once

#include <vtkIndent.h>
#include <vtkType.h>
#include <vtkWrappingHints.h>

#include <memory>
#include <ostream>

class vtkAlgorithm;

namespace cactus
{

/// The properties of some stage by name. Values are checked when the filter runs. A name that the stage does not have, or has
/// with another type, throws std::logic_error.
class FilterProperties
{
public:
  FilterProperties() = default;
  virtual ~FilterProperties() = default;
  FilterProperties(const FilterProperties&) = delete;
  FilterProperties& operator=(const FilterProperties&) = delete;

  /// Each sets a value, and tells whether it differed before. A null text counts as empty.
  virtual bool changeNumber(const char* name, double value) = 0;
  virtual bool changeWhole(const char* name, int value) = 0; ///< also a choice
  virtual bool changeSwitch(const char* name, bool value) = 0;
  virtual bool changeText(const char* name, const char* value) = 0;
  virtual bool changeVector(const char* name, const double value[3]) = 0;
  virtual double number(const char* name) const = 0;
  virtual int whole(const char* name) const = 0;
  virtual bool isOn(const char* name) const = 0;
  /// Returns null for an empty text, as in VTK; valid until the next call for the same name.
  virtual const char* text(const char* name) const = 0;
  virtual void getVector(const char* name, double value[3]) const = 0;
  /// Prints all of them, a line each.
  virtual void print(std::ostream& out, vtkIndent indent) const = 0;
};

/// Does the same as vtkAlgorithm::ComputePipelineMTime, except that a stopped filter counts as changed until it has run, so that
/// whoever requests its output gets the warning; later stages would otherwise not request it again. Not for several ranks, of
/// which one would enter an exchange alone: these run again after a change, or by Write.
int pipelineTime(vtkAlgorithm* self, vtkMTimeType* time);

} // namespace cactus

/// Prints the properties as well, for a class with a member `std::unique_ptr<cactus::FilterProperties> Properties`.
#define CACTUS_PRINTS_PROPERTIES                                                                                                 \
  void PrintSelf(ostream& os, vtkIndent indent) override                                                                         \
  {                                                                                                                              \
    this->Superclass::PrintSelf(os, indent);                                                                                     \
    this->Properties->print(os, indent);                                                                                         \
  }

/// Counts as changed after it was stopped, so that a new request repeats the warning; not on several ranks.
#define CACTUS_COUNTS_AS_CHANGED_ONCE_STOPPED                                                                                    \
  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* time) override     \
  {                                                                                                                              \
    return cactus::pipelineTime(this, time);                                                                                     \
  }

/// Asks a run to stop without changing the filter: of several ranks, one that was asked too late would otherwise run again, and
/// wait for the others.
#define CACTUS_ABORT_IS_NO_CHANGE                                                                                                \
  void SetAbortExecute(vtkTypeBool wanted) override                                                                              \
  {                                                                                                                              \
    this->AbortExecute = wanted;                                                                                                 \
  }

// Set and Get methods of a class with a member `std::unique_ptr<cactus::FilterProperties> Properties`.
#define CACTUS_NUMBER_PROPERTY(name)                                                                                             \
  virtual void Set##name(double value)                                                                                           \
  {                                                                                                                              \
    if (this->Properties->changeNumber(#name, value))                                                                            \
    {                                                                                                                            \
      this->Modified();                                                                                                          \
    }                                                                                                                            \
  }                                                                                                                              \
  virtual double Get##name()                                                                                                     \
  {                                                                                                                              \
    return this->Properties->number(#name);                                                                                      \
  }

#define CACTUS_WHOLE_PROPERTY(name)                                                                                              \
  virtual void Set##name(int value)                                                                                              \
  {                                                                                                                              \
    if (this->Properties->changeWhole(#name, value))                                                                             \
    {                                                                                                                            \
      this->Modified();                                                                                                          \
    }                                                                                                                            \
  }                                                                                                                              \
  virtual int Get##name()                                                                                                        \
  {                                                                                                                              \
    return this->Properties->whole(#name);                                                                                       \
  }

#define CACTUS_SWITCH_PROPERTY(name)                                                                                             \
  virtual void Set##name(bool value)                                                                                             \
  {                                                                                                                              \
    if (this->Properties->changeSwitch(#name, value))                                                                            \
    {                                                                                                                            \
      this->Modified();                                                                                                          \
    }                                                                                                                            \
  }                                                                                                                              \
  virtual bool Get##name()                                                                                                       \
  {                                                                                                                              \
    return this->Properties->isOn(#name);                                                                                        \
  }                                                                                                                              \
  virtual void name##On()                                                                                                        \
  {                                                                                                                              \
    this->Set##name(true);                                                                                                       \
  }                                                                                                                              \
  virtual void name##Off()                                                                                                       \
  {                                                                                                                              \
    this->Set##name(false);                                                                                                      \
  }

#define CACTUS_TEXT_PROPERTY(name)                                                                                               \
  virtual void Set##name(const char* value)                                                                                      \
  {                                                                                                                              \
    if (this->Properties->changeText(#name, value))                                                                              \
    {                                                                                                                            \
      this->Modified();                                                                                                          \
    }                                                                                                                            \
  }                                                                                                                              \
  virtual const char* Get##name()                                                                                                \
  {                                                                                                                              \
    return this->Properties->text(#name);                                                                                        \
  }

#define CACTUS_FILE_PROPERTY(name)                                                                                               \
  virtual void Set##name(VTK_FILEPATH const char* value)                                                                         \
  {                                                                                                                              \
    if (this->Properties->changeText(#name, value))                                                                              \
    {                                                                                                                            \
      this->Modified();                                                                                                          \
    }                                                                                                                            \
  }                                                                                                                              \
  virtual VTK_FILEPATH const char* Get##name()                                                                                   \
  {                                                                                                                              \
    return this->Properties->text(#name);                                                                                        \
  }

#define CACTUS_VECTOR_PROPERTY(name)                                                                                             \
  virtual void Set##name(double x, double y, double z)                                                                           \
  {                                                                                                                              \
    const double value[3] = { x, y, z };                                                                                         \
    if (this->Properties->changeVector(#name, value))                                                                            \
    {                                                                                                                            \
      this->Modified();                                                                                                          \
    }                                                                                                                            \
  }                                                                                                                              \
  void Set##name(const double value[3])                                                                                          \
  {                                                                                                                              \
    this->Set##name(value[0], value[1], value[2]);                                                                               \
  }                                                                                                                              \
  virtual void Get##name(double value[3])                                                                                        \
  {                                                                                                                              \
    this->Properties->getVector(#name, value);                                                                                   \
  }
