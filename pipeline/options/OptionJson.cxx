// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/JsonFile.h"
#include "options/NearestWord.h"
#include "options/OptionSetter.h"

#include <limits>

namespace novelview
{
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace
{
/** Sets a target from a JSON value. */
class JsonSetter : public OptionSetter
{
public:
  JsonSetter(
    const Option& option, const Json& value, const fs::path& folder, const std::string& where)
    : OptionSetter(option, where + ", key \"" + option.Key + "\"")
    , Value(value)
    , Folder(folder)
  {
  }

  void operator()(bool* target) const
  {
    this->Need(this->Value.is_boolean(), "true or false");
    *target = this->Value.get<bool>();
  }
  void operator()(int* target) const { *target = this->Whole(this->Value); }
  void operator()(double* target) const { *target = this->Number(this->Value); }
  void operator()(std::string* target) const { *target = this->OfChoices(this->Text(this->Value)); }
  void operator()(fs::path* target) const { *target = this->Rebased(this->Text(this->Value)); }
  void operator()(std::optional<double>* target) const
  {
    target->reset();
    if (!this->Value.is_null())
    {
      *target = this->Number(this->Value);
    }
  }
  void operator()(std::optional<std::array<double, 6>>* target) const
  {
    target->reset();
    if (this->Value.is_null())
    {
      return;
    }
    this->Need(this->Value.is_array() && this->Value.size() == 6, "an array of 6 numbers");
    std::vector<double> values;
    for (const Json& value : this->Value)
    {
      values.push_back(this->Number(value));
    }
    CheckBox(values, this->Where);
    target->emplace();
    std::copy(values.begin(), values.end(), (*target)->begin());
  }
  void operator()(std::vector<std::string>* target) const
  {
    this->Fill(*target, "an array of texts", [this](const Json& each) { return this->Text(each); });
  }
  void operator()(std::vector<fs::path>* target) const
  {
    this->Fill(*target, "an array of paths",
      [this](const Json& each) { return this->Rebased(this->Text(each)); });
  }
  void operator()(std::vector<double>* target) const
  {
    this->Fill(
      *target, "an array of numbers", [this](const Json& each) { return this->Number(each); });
  }
  void operator()(std::vector<int>* target) const
  {
    this->Fill(
      *target, "an array of whole numbers", [this](const Json& each) { return this->Whole(each); });
  }
  void operator()(const WordTarget& target) const
  {
    target.Set(this->Text(this->Value), this->Where,
      [this](const fs::path& path) { return this->Rebased(path); });
  }
  void operator()(const SizeTarget& target) const
  {
    this->SetSize(target, this->Text(this->Value));
  }

private:
  void Need(bool fits, const std::string& expected) const
  {
    if (!fits)
    {
      throw UsageError(this->Where, "has the wrong type", JsonTypeText(this->Value), expected);
    }
  }
  double Number(const Json& value) const
  {
    this->Need(value.is_number(), "a number");
    return this->InRange(value.get<double>());
  }
  int Whole(const Json& value) const
  {
    this->Need(value.is_number_integer(), "a whole number");
    // Every number of 32 bits is a double.
    const double number = this->InRange(value.get<double>());
    this->Need(
      number >= std::numeric_limits<int>::min() && number <= std::numeric_limits<int>::max(),
      "a whole number of 32 bits");
    return static_cast<int>(number);
  }
  std::string Text(const Json& value) const
  {
    this->Need(value.is_string(), "a text");
    return value.get<std::string>();
  }
  template <class T, class Convert>
  void Fill(std::vector<T>& target, const char* expected, const Convert& convert) const
  {
    this->Need(this->Value.is_array(), expected);
    target.clear();
    for (const Json& each : this->Value)
    {
      target.push_back(convert(each));
    }
  }
  fs::path Rebased(const fs::path& path) const
  {
    return path.empty() || path.is_absolute() ? path : (this->Folder / path).lexically_normal();
  }

  const Json& Value;
  const fs::path& Folder;
};

/** A target as JSON. */
class JsonGetter
{
public:
  explicit JsonGetter(const fs::path& folder)
    : Folder(fs::weakly_canonical(fs::absolute(folder)))
  {
  }

  Json operator()(const std::optional<double>* target) const
  {
    return *target ? Json(**target) : Json();
  }
  Json operator()(const std::optional<std::array<double, 6>>* target) const
  {
    return *target ? Json(**target) : Json();
  }
  Json operator()(const fs::path* target) const { return this->Absolute(*target).string(); }
  Json operator()(const std::vector<fs::path>* target) const
  {
    Json paths = Json::array();
    for (const fs::path& path : *target)
    {
      paths.push_back(this->Absolute(path).string());
    }
    return paths;
  }
  Json operator()(const WordTarget& target) const
  {
    return target.Get([this](const fs::path& path) { return this->Absolute(path); });
  }
  Json operator()(const SizeTarget& target) const
  {
    return SizeText(*target.Width, *target.Height);
  }
  template <class T>
  Json operator()(const T* target) const
  {
    return *target;
  }

private:
  fs::path Absolute(const fs::path& path) const
  {
    if (path.empty())
    {
      return path;
    }
    const fs::path whole = fs::weakly_canonical(fs::absolute(path));
    const fs::path inside = whole.lexically_relative(this->Folder);
    return inside.empty() || *inside.begin() == ".." ? whole : inside;
  }

  fs::path Folder;
};

/** The option of a key. Throws UsageError when there is none. */
const Option& KnownOption(
  const OptionTable& table, const std::string& key, const std::string& where)
{
  if (const Option* option = OptionOfKey(table, key))
  {
    return *option;
  }
  std::vector<std::string> keys;
  for (const Option& option : table)
  {
    keys.push_back(option.Key);
  }
  const std::string nearest = NearestWord(key, keys);
  throw UsageError(where,
    "unknown key \"" + key + "\"" + (nearest.empty() ? "" : ", did you mean \"" + nearest + "\"?"));
}
}

void SetFromJson(const OptionTable& table, const Json& object, const fs::path& folder,
  const std::string& where, const OptionWarning& warn)
{
  for (const auto& [key, value] : object.items())
  {
    const Option& option = KnownOption(table, key, where);
    if (key != option.Key)
    {
      const std::string text = "key \"" + key + "\" is now \"" + option.Key + "\"";
      if (object.contains(option.Key))
      {
        throw UsageError(where, text + ", which is there, too");
      }
      if (warn)
      {
        warn(where + ", " + text);
      }
    }
    std::visit(JsonSetter(option, value, folder, where), option.Target);
  }
}

Json ToJson(const OptionTable& table, const fs::path& folder)
{
  const JsonGetter getter(folder);
  Json object = Json::object();
  for (const Option& option : table)
  {
    if (option.InJob)
    {
      object[option.Key] = std::visit(getter, option.Target);
    }
  }
  return object;
}

Json ReadJsonObject(const fs::path& path)
{
  Json object;
  try
  {
    object = ReadJsonFile(path);
  }
  catch (const Error& error)
  {
    throw UsageError(error);
  }
  if (!object.is_object())
  {
    throw UsageError(path.string(), "is not a job", object.type_name(), "a JSON object");
  }
  return object;
}
}
