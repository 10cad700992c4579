// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/OpenCvStorageYaml.h"

#include "core/Error.h"
#include "core/PrintableText.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>

namespace novelview
{
namespace
{
using Kind = StorageNode::Kind;

/**
 * Builds the tree while the parser reads. The parser works by recursion, so that refusing a level
 * that is too deep here stops it, too.
 */
class YamlBuilder : public YAML::EventHandler
{
public:
  explicit YamlBuilder(const std::string& where)
    : Where(where)
  {
  }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { this->Add({}, mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { this->RefuseAnchor(mark); }
  void OnAnchor(const YAML::Mark& mark, const std::string&) override { this->RefuseAnchor(mark); }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
    const std::string& value) override
  {
    // What stands in quotes has the tag "!".
    StorageNode node = ScalarNode(value);
    node.What = tag == "!" ? Kind::Text : node.What;
    this->Add(std::move(node), mark);
  }
  void OnSequenceStart(
    const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override
  {
    this->Begin(Kind::List, mark);
  }
  void OnMapStart(
    const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override
  {
    this->Begin(Kind::Map, mark);
  }
  void OnSequenceEnd() override { this->End(); }
  void OnMapEnd() override { this->End(); }

  std::string PlaceOf(const YAML::Mark& mark) const
  {
    return mark.line < 0 ? this->Where : this->Where + ", line " + std::to_string(mark.line + 1);
  }

  StorageNode Root;

private:
  /** A list or map that has not ended. */
  struct Level
  {
    StorageNode Node;
    YAML::Mark Begin;
    std::string Key; ///< of the next value of a map
    bool HasKey = false;
  };

  [[noreturn]] void RefuseAnchor(const YAML::Mark& mark) const
  {
    throw Error(this->PlaceOf(mark), "anchors and aliases (& and *) are not read");
  }

  void Begin(Kind kind, const YAML::Mark& mark)
  {
    if (this->Open.size() == MaxStorageNesting)
    {
      throw Error(this->PlaceOf(mark), "is nested too deep",
        "more than " + std::to_string(MaxStorageNesting) + " levels", "fewer");
    }
    this->Open.emplace_back();
    this->Open.back().Node.What = kind;
    this->Open.back().Begin = mark;
  }

  void End()
  {
    const Level level = std::move(this->Open.back());
    this->Open.pop_back();
    this->Add(level.Node, level.Begin);
  }

  void Add(StorageNode node, const YAML::Mark& mark)
  {
    if (this->Open.empty())
    {
      this->Root = std::move(node);
      return;
    }
    Level& level = this->Open.back();
    if (level.Node.IsList())
    {
      level.Node.Items.push_back(std::move(node));
    }
    else if (level.HasKey)
    {
      level.Node.Entries.push_back({ level.Key, std::move(node) });
      level.HasKey = false;
    }
    else if (node.IsText() || node.What == Kind::Number)
    {
      level.Key = node.Text;
      level.HasKey = true;
    }
    else
    {
      throw Error(this->PlaceOf(mark), "a key is not a text");
    }
  }

  const std::string& Where;
  std::vector<Level> Open;
};

/** Without OpenCV's first line, "%YAML:1.0", which is no YAML; the line stays as an empty one. */
std::string WithoutHeader(const std::string& text)
{
  const std::size_t begin = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  if (text.compare(begin, 5, "%YAML") != 0)
  {
    return text.substr(begin);
  }
  const std::size_t end = text.find_first_of("\r\n", begin);
  return end == std::string::npos ? "" : text.substr(end);
}

void CheckEncoding(const std::string& text, const std::string& where)
{
  if (!IsUtf8(text))
  {
    throw Error(where, "its text is not UTF-8");
  }
}
}

StorageNode ParseStorageYaml(const std::string& text, const std::string& where)
{
  CheckEncoding(text, where);
  YamlBuilder builder(where);
  std::istringstream stream(WithoutHeader(text));
  try
  {
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
  }
  catch (const YAML::Exception& error)
  {
    throw Error(
      builder.PlaceOf(error.mark), "is not a calibration of OpenCV: this is not valid YAML");
  }
  return std::move(builder.Root);
}
}
