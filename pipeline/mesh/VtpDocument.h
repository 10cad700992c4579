// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_VtpDocument_h
#define novelview_VtpDocument_h

#include <pugixml.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace novelview
{
/** The XML of a VTP file; finds its elements and attributes, and their places for errors. */
class VtpDocument
{
public:
  /** Throws Error when the bytes are no XML, or that of another kind of file. */
  VtpDocument(std::string_view bytes, std::string file);
  VtpDocument(const VtpDocument&) = delete;
  VtpDocument& operator=(const VtpDocument&) = delete;

  /** The element VTKFile. */
  pugi::xml_node Root() const { return this->Tree.child("VTKFile"); }

  /** What is behind the "_" of AppendedData. */
  std::string_view Appended() const { return this->AppendedBytes; }

  /** Whether that is in base64. */
  bool IsAppendedBase64() const { return this->Base64; }

  std::string_view Bytes() const { return this->AllBytes; }

  /** "FILE, line 12": where an element begins. */
  std::string Where(const pugi::xml_node& element) const;

  /** An attribute that is a count; `missing` where there is none. Throws Error. */
  std::uint64_t Count(const pugi::xml_node& element, const char* name, std::uint64_t missing) const;

private:
  void Parse(std::string_view text);

  std::string_view AllBytes;
  std::string File;
  pugi::xml_document Tree;
  std::string_view AppendedBytes;
  bool Base64 = false;
};
}

#endif
