// SPDX-License-Identifier: GPL-3.0-or-later
#include "Options.h"

#include "JsonFile.h"
#include "NumberText.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <numeric>
#include <type_traits>

namespace novelview
{
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace
{
constexpr std::array<std::pair<Stage, const char*>, 3> StageNames{ { { Stage::Hull, "hull" },
  { Stage::Outline, "outline" }, { Stage::Full, "full" } } };

std::string StageName(Stage stage)
{
  for (const auto& [each, name] : StageNames)
  {
    if (each == stage)
    {
      return name;
    }
  }
  return "";
}

template <class T>
std::string ListText(const T& values)
{
  std::vector<std::string> words;
  for (const auto value : values)
  {
    words.push_back(NumberText(value));
  }
  return Joined(words, ",");
}

/** x0 y0 z0 x1 y1 z1: every second value must be above the first. */
void CheckBox(const std::vector<double>& values, const std::string& where)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!(values[axis] < values[axis + 3]))
    {
      throw UsageError(where, "is no box", ListText(values), "x0,y0,z0,x1,y1,z1 with x0 < x1 ...");
    }
  }
}

template <class T>
T ParsedNumber(const std::string& word, const std::string& where)
{
  T number{};
  const char* begin = word.data() + (word.size() > 1 && word[0] == '+' ? 1 : 0);
  const char* end = word.data() + word.size();
  const auto [stop, failure] = std::from_chars(begin, end, number);
  if (failure != std::errc() || stop != end)
  {
    throw UsageError(where,
      std::string("is no ") + (std::is_integral_v<T> ? "whole number" : "number"), "'" + word + "'",
      std::is_integral_v<T> ? "a whole number" : "a number");
  }
  return number;
}

/** Checks and stores values of the types that options have, whatever they were read from. */
class Setter
{
public:
  Setter(const Option& option, std::string where)
    : Table(option)
    , Where(std::move(where))
  {
  }

  template <class T>
  T InRange(T value) const
  {
    // Written so that a NaN is out of every range.
    if (!(value >= this->Table.Least && value <= this->Table.Most))
    {
      throw UsageError(this->Where, "is out of range", NumberText(value), RangeText(this->Table));
    }
    return value;
  }
  std::string OfChoices(const std::string& word) const
  {
    const std::vector<std::string>& choices = this->Table.Choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), word) == choices.end())
    {
      throw UsageError(this->Where, "is no such choice", "'" + word + "'", RangeText(this->Table));
    }
    return word;
  }
  Stage StageOf(const std::string& word) const
  {
    for (const auto& [stage, name] : StageNames)
    {
      if (word == name)
      {
        return stage;
      }
    }
    throw UsageError(this->Where, "is no stage", "'" + word + "'", RangeText(this->Table));
  }
  void SetSize(const SizeTarget& target, const std::string& word) const
  {
    const std::size_t cross = word.find('x');
    if (cross == std::string::npos)
    {
      throw UsageError(this->Where, "is no size", "'" + word + "'", "like 640x480");
    }
    *target.Width = this->InRange(ParsedNumber<int>(word.substr(0, cross), this->Where));
    *target.Height = this->InRange(ParsedNumber<int>(word.substr(cross + 1), this->Where));
  }

protected:
  const Option& Table;
  std::string Where;
};

/** Sets a target from words of a command line. */
class TextSetter : public Setter
{
public:
  TextSetter(const Option& option, const std::vector<std::string>& words)
    : Setter(option, FlagOf(option.Key))
    , Words(words)
  {
  }

  void operator()(bool* target) const
  {
    const std::string word = this->One();
    if (word != "true" && word != "false")
    {
      throw UsageError(this->Where, "is a switch", "'" + word + "'", "true or false");
    }
    *target = word == "true";
  }
  void operator()(int* target) const { *target = this->Number<int>(this->One()); }
  void operator()(double* target) const { *target = this->Number<double>(this->One()); }
  void operator()(std::string* target) const { *target = this->OfChoices(this->One()); }
  void operator()(fs::path* target) const { *target = this->One(); }
  void operator()(std::optional<double>* target) const
  {
    *target = this->Number<double>(this->One());
  }
  void operator()(std::optional<std::array<double, 6>>* target) const
  {
    const std::vector<double> values = this->Numbers<double>();
    if (values.size() != 6)
    {
      throw UsageError(
        this->Where, "has the wrong length", std::to_string(values.size()) + " numbers", "6");
    }
    CheckBox(values, this->Where);
    target->emplace();
    std::copy(values.begin(), values.end(), (*target)->begin());
  }
  void operator()(std::vector<std::string>* target) const { *target = this->Words; }
  void operator()(std::vector<fs::path>* target) const
  {
    target->assign(this->Words.begin(), this->Words.end());
  }
  void operator()(std::vector<double>* target) const { *target = this->Numbers<double>(); }
  void operator()(std::vector<int>* target) const { *target = this->Numbers<int>(); }
  void operator()(Stage* target) const { *target = this->StageOf(this->One()); }
  void operator()(ViewSpec* target) const { *target = ParseViewSpec(this->One()); }
  void operator()(const SizeTarget& target) const { this->SetSize(target, this->One()); }

private:
  const std::string& One() const
  {
    if (this->Words.size() != 1)
    {
      throw UsageError(
        this->Where, "takes one value", std::to_string(this->Words.size()) + " values", "1");
    }
    return this->Words.front();
  }
  template <class T>
  T Number(const std::string& word) const
  {
    return this->InRange(ParsedNumber<T>(word, this->Where));
  }
  template <class T>
  std::vector<T> Numbers() const
  {
    std::vector<T> values;
    for (const std::string& word : this->Words)
    {
      values.push_back(this->Number<T>(word));
    }
    return values;
  }

  const std::vector<std::string>& Words;
};

/** Sets a target from a JSON value. */
class JsonSetter : public Setter
{
public:
  JsonSetter(
    const Option& option, const Json& value, const fs::path& folder, const std::string& where)
    : Setter(option, where + ", key \"" + option.Key + "\"")
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
  void operator()(Stage* target) const { *target = this->StageOf(this->Text(this->Value)); }
  void operator()(ViewSpec* target) const
  {
    *target = ParseViewSpec(this->Text(this->Value));
    target->ParFile = this->Rebased(target->ParFile);
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
  Json operator()(const Stage* target) const { return StageName(*target); }
  Json operator()(const ViewSpec* target) const
  {
    ViewSpec spec = *target;
    spec.ParFile = this->Absolute(spec.ParFile);
    return ViewSpecText(spec);
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

struct TextGetter
{
  std::string operator()(const bool* target) const { return *target ? "true" : "false"; }
  std::string operator()(const int* target) const { return std::to_string(*target); }
  std::string operator()(const double* target) const { return NumberText(*target); }
  std::string operator()(const std::string* target) const { return *target; }
  std::string operator()(const fs::path* target) const { return target->string(); }
  std::string operator()(const std::optional<double>* target) const
  {
    return *target ? NumberText(**target) : "";
  }
  std::string operator()(const std::optional<std::array<double, 6>>* target) const
  {
    return *target ? ListText(**target) : "";
  }
  std::string operator()(const std::vector<std::string>* target) const
  {
    return Joined(*target, ",");
  }
  std::string operator()(const std::vector<fs::path>* target) const
  {
    return Joined({ target->begin(), target->end() }, ",");
  }
  std::string operator()(const std::vector<double>* target) const { return ListText(*target); }
  std::string operator()(const std::vector<int>* target) const { return ListText(*target); }
  std::string operator()(const Stage* target) const { return StageName(*target); }
  std::string operator()(const ViewSpec* target) const { return ViewSpecText(*target); }
  std::string operator()(const SizeTarget& target) const
  {
    return SizeText(*target.Width, *target.Height);
  }
};

/** Levenshtein distance. */
std::size_t EditDistance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{ 0 });
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const std::size_t replaced = diagonal +
        (std::tolower(static_cast<unsigned char>(a[i])) !=
          std::tolower(static_cast<unsigned char>(b[j])));
      diagonal = row[j + 1];
      row[j + 1] = std::min({ replaced, row[j] + 1, row[j + 1] + 1 });
    }
  }
  return row.back();
}
}

std::string FlagOf(const std::string& key)
{
  std::string flag = "--";
  for (const char c : key)
  {
    if (std::isupper(static_cast<unsigned char>(c)))
    {
      flag += '-';
    }
    flag += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return flag;
}

std::string ValueText(const Option& option)
{
  return std::visit(TextGetter(), option.Target);
}

std::string RangeText(const Option& option)
{
  if (!option.Choices.empty())
  {
    return Joined(option.Choices);
  }
  if (std::holds_alternative<Stage*>(option.Target))
  {
    return "hull, outline, full";
  }
  const bool from = std::isfinite(option.Least);
  const bool to = std::isfinite(option.Most);
  if (from && to)
  {
    return NumberText(option.Least) + " to " + NumberText(option.Most);
  }
  return from ? "at least " + NumberText(option.Least)
              : (to ? "at most " + NumberText(option.Most) : "");
}

void SetFromText(const Option& option, const std::vector<std::string>& words)
{
  std::visit(TextSetter(option, words), option.Target);
}

std::string NearestWord(const std::string& word, const std::vector<std::string>& known)
{
  std::string nearest;
  constexpr std::size_t Longest = 100; // nobody misspells such a word, and comparing takes long
  if (word.size() > Longest)
  {
    return nearest;
  }
  // A third of the letters wrong is still a misspelling; more is another word.
  std::size_t least = std::max<std::size_t>(word.size() / 3, 1) + 1;
  for (const std::string& each : known)
  {
    const std::size_t distance = EditDistance(word, each);
    if (distance < least)
    {
      least = distance;
      nearest = each;
    }
  }
  return nearest;
}

void SetFromJson(
  const OptionTable& table, const Json& object, const fs::path& folder, const std::string& where)
{
  std::vector<std::string> keys;
  for (const Option& option : table)
  {
    keys.push_back(option.Key);
  }
  for (const auto& [key, value] : object.items())
  {
    const auto found = std::find(keys.begin(), keys.end(), key);
    if (found == keys.end())
    {
      const std::string nearest = NearestWord(key, keys);
      throw UsageError(where,
        "unknown key \"" + key + "\"" +
          (nearest.empty() ? "" : ", did you mean \"" + nearest + "\"?"));
    }
    const Option& option = table[static_cast<std::size_t>(found - keys.begin())];
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
    throw UsageError(path.string(), "is no job", object.type_name(), "a JSON object");
  }
  return object;
}
}
