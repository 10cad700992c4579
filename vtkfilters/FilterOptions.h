// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Filter options that live in an option struct of the kernels. In the class of a filter,
 *
 *     vtkFilterOptionsMacro(novelview::OutlineOptions);
 *
 * declares the struct as the member `Options`, and SetOptions() and GetOptions() for all of it.
 *
 *     vtkFilterOptionMacro(SearchRange, double, SearchPx);
 *
 * declares the Set/Get pair of one member, Options.SearchPx. Its range is the struct's
 * SearchPxParameter (core/Parameter.h). vtkFilterSwitchMacro(UseGains, UseGains) does the same for a
 * bool, with On and Off. PrintOptions(), called by PrintSelf(), prints all of them.
 */
#ifndef novelview_FilterOptions_h
#define novelview_FilterOptions_h

#include "core/Parameter.h"

#include <vtkIndent.h>
#include <vtkSetGet.h>

#include <type_traits>
#include <vector>

namespace novelview
{
/** Names and addresses of the options of a filter, for PrintSelf(). */
class PrintedOptions
{
public:
  void Print(ostream& os, vtkIndent indent) const
  {
    for (const Entry& entry : this->Entries)
    {
      os << indent << entry.Name << ": ";
      entry.Print(os, entry.Value);
      os << "\n";
    }
  }

  /** As a member of the filter, adds an option of this filter. */
  struct Entry
  {
    template <class T>
    Entry(PrintedOptions& options, const char* name, const T& value)
      : Name(name)
      , Value(&value)
      , Print(PrintValue<T>)
    {
      options.Entries.push_back(*this);
    }

    /** A number, or "on" or "off". */
    template <class T>
    static void PrintValue(ostream& os, const void* value)
    {
      if constexpr (std::is_same_v<T, bool>)
      {
        os << (*static_cast<const bool*>(value) ? "on" : "off");
      }
      else
      {
        os << *static_cast<const T*>(value);
      }
    }

    const char* Name;
    const void* Value;
    void (*Print)(ostream& os, const void* value);
  };

private:
  std::vector<Entry> Entries;
};

template <class T>
T Clamped(T value, const Parameter<T>& parameter)
{
  return value < parameter.Min ? parameter.Min : (value > parameter.Max ? parameter.Max : value);
}
}

#ifdef __VTK_WRAP__
// The wrappers need the methods only, and cannot convert the structs of the kernels.
#define vtkFilterOptionsMacro(type)
#define vtkFilterOptionMacro(name, type, member)                                                   \
  virtual void Set##name(type value);                                                              \
  virtual type Get##name();                                                                        \
  virtual type Get##name##MinValue();                                                              \
  virtual type Get##name##MaxValue()
#define vtkFilterSwitchMacro(name, member)                                                         \
  virtual void Set##name(bool value);                                                              \
  virtual bool Get##name();                                                                        \
  virtual void name##On();                                                                         \
  virtual void name##Off()
#else
/** All options, without a check of their ranges. */
#define vtkFilterOptionsMacro(type)                                                                \
  virtual void SetOptions(const type& options)                                                     \
  {                                                                                                \
    this->Options = options;                                                                       \
    this->Modified();                                                                              \
  }                                                                                                \
  virtual const type& GetOptions() const                                                           \
  {                                                                                                \
    return this->Options;                                                                          \
  }                                                                                                \
                                                                                                   \
protected:                                                                                         \
  void PrintOptions(ostream& os, vtkIndent indent) const                                           \
  {                                                                                                \
    this->Printed.Print(os, indent);                                                               \
  }                                                                                                \
  type Options;                                                                                    \
  novelview::PrintedOptions Printed;                                                               \
                                                                                                   \
public:

#define vtkFilterMemberMacro(name, type, member, value)                                            \
  virtual void Set##name(type _arg)                                                                \
  {                                                                                                \
    if (this->Options.member != (value))                                                           \
    {                                                                                              \
      this->Options.member = (value);                                                              \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
                                                                                                   \
protected:                                                                                         \
  const novelview::PrintedOptions::Entry name##Entry{ this->Printed, #name,                        \
    this->Options.member };                                                                        \
                                                                                                   \
public:                                                                                            \
  virtual type Get##name()                                                                         \
  {                                                                                                \
    return this->Options.member;                                                                   \
  }

#define vtkFilterOptionMacro(name, type, member)                                                   \
  vtkFilterMemberMacro(                                                                            \
    name, type, member, novelview::Clamped<type>(_arg, this->Options.member##Parameter));          \
  virtual type Get##name##MinValue()                                                               \
  {                                                                                                \
    return this->Options.member##Parameter.Min;                                                    \
  }                                                                                                \
  virtual type Get##name##MaxValue()                                                               \
  {                                                                                                \
    return this->Options.member##Parameter.Max;                                                    \
  }

#define vtkFilterSwitchMacro(name, member)                                                         \
  vtkFilterMemberMacro(name, bool, member, _arg);                                                  \
  vtkBooleanMacro(name, bool)
#endif

#endif
