// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SharedLibrary_h
#define novelview_SharedLibrary_h

#include "core/Error.h"

#include <string>
#include <vector>

#include <dlfcn.h>

namespace novelview
{
/** A shared library of the system that stays loaded: drivers do not survive being unloaded. */
class SharedLibrary
{
public:
  /** Takes the first of `names` that is there. Throws Error with the Debian package that has it. */
  SharedLibrary(const std::vector<const char*>& names, const char* package)
    : Name(names.front())
  {
    for (const char* name : names)
    {
      this->Handle = dlopen(name, RTLD_NOW | RTLD_LOCAL);
      if (this->Handle)
      {
        return;
      }
    }
    const char* const reason = dlerror();
    throw Error(this->Name,
      std::string("the library cannot be loaded (") + (reason ? reason : "no reason given") +
        "); Debian's package " + package + " has it");
  }

  /** Sets `function` to the one of this name. Throws Error when there is none. */
  template <class Signature>
  void Bind(Signature*& function, const char* name) const
  {
    function = reinterpret_cast<Signature*>(dlsym(this->Handle, name));
    if (!function)
    {
      throw Error(this->Name, std::string("the library has no function ") + name);
    }
  }

private:
  std::string Name;
  void* Handle = nullptr;
};
}

#endif
