// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/OpenCvStorageXml.h"

#include "core/Error.h"

#include <pugixml.hpp>

#include <algorithm>

namespace novelview
{
namespace
{
using Kind = StorageNode::Kind;

const char* const Blanks = " \t\r\n";
const char* const RootName = "opencv_storage";
const std::string ItemName = "_"; ///< of an element that is an item of a list

/** Makes the tree of the elements below the root. */
class XmlBuilder
{
public:
  XmlBuilder(const std::string& text, const std::string& where)
    : Text(text)
    , Where(where)
  {
  }

  std::string PlaceOf(std::ptrdiff_t offset) const
  {
    const auto at = std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(this->Text));
    const auto line = 1 + std::count(this->Text.begin(), this->Text.begin() + at, '\n');
    return this->Where + ", line " + std::to_string(line);
  }

  StorageNode NodeOf(const pugi::xml_node& element, int depth) const
  {
    if (depth > MaxStorageNesting)
    {
      throw Error(this->PlaceOf(element.offset_debug()), "is nested too deep",
        "more than " + std::to_string(MaxStorageNesting) + " levels", "fewer");
    }
    StorageNode node;
    for (const pugi::xml_node& child : element.children())
    {
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
      {
        AppendWords(child.value(), node.Items);
      }
      else if (child.type() == pugi::node_element && child.name() == ItemName)
      {
        node.Items.push_back(this->NodeOf(child, depth + 1));
        node.What = Kind::List;
      }
      else if (child.type() == pugi::node_element)
      {
        node.Entries.push_back({ child.name(), this->NodeOf(child, depth + 1) });
      }
    }
    return this->OfItsKind(std::move(node), element);
  }

private:
  /** Appends words between blanks; "in quotes" is one. */
  static void AppendWords(const std::string& text, std::vector<StorageNode>& items)
  {
    for (std::size_t at = text.find_first_not_of(Blanks); at != std::string::npos;
         at = text.find_first_not_of(Blanks, at))
    {
      const bool quoted = text[at] == '"';
      const std::size_t begin = at + (quoted ? 1 : 0);
      const std::size_t end = quoted ? text.find('"', begin) : text.find_first_of(Blanks, begin);
      const std::size_t stop = std::min(end, text.size());
      StorageNode word = ScalarNode(text.substr(begin, stop - begin));
      word.What = quoted ? Kind::Text : word.What;
      items.push_back(std::move(word));
      at = std::min(stop + (quoted ? 1 : 0), text.size());
    }
  }

  StorageNode OfItsKind(StorageNode node, const pugi::xml_node& element) const
  {
    if (!node.Entries.empty())
    {
      if (!node.Items.empty())
      {
        throw Error(this->PlaceOf(element.offset_debug()),
          std::string("element \"") + element.name() + "\" mixes values and named elements");
      }
      node.What = Kind::Map;
    }
    else if (node.Items.size() == 1 && !node.IsList())
    {
      return std::move(node.Items.front());
    }
    else if (!node.Items.empty())
    {
      node.What = Kind::List;
    }
    return node;
  }

  const std::string& Text;
  const std::string& Where;
};
}

StorageNode ParseStorageXml(const std::string& text, const std::string& where)
{
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  const XmlBuilder builder(text, where);
  if (result.status == pugi::status_out_of_memory)
  {
    throw std::bad_alloc();
  }
  if (!result)
  {
    throw Error(
      builder.PlaceOf(result.offset), "is not a calibration of OpenCV: this is not valid XML");
  }
  const pugi::xml_node root = document.document_element();
  if (root.name() != std::string(RootName))
  {
    throw Error(where, "is not a calibration of OpenCV",
      std::string("element \"") + root.name() + "\"", std::string("\"") + RootName + "\"");
  }
  return builder.NodeOf(root, 0);
}
}
