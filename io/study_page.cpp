// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "io/study_schema.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

constexpr std::string_view kOpening = R"(# The study file

One [TOML](https://toml.io) file says what to compute. Every key has a default, so that `clerestory daylight model.obj` works with no
study at all. Unknown keys are errors that name the nearest known one. Paths are relative to the study file.

```toml
[model]
file  = "office.obj"
units = "m"

[materials.wall]
reflectance = 0.5
[materials."glass*"]
glazing = { transmittance = 0.70 }

[[grids]]
name    = "workplane"
surface = "floor"
height  = 0.8
spacing = 0.25

[accuracy]
target = "2%"
```

On the command line `--set table.key=value` overrides any key: `--set accuracy.target=0.05`, `--set grids.0.spacing=0.5`,
`--set 'materials."glass*".glazing.transmittance=0.6'`.

All keys; `*` stands for any name, `[]` for each table of a list. Keys marked ¹ belong to the format and are refused by this version.

| key | value | unit | default | meaning |
|---|---|---|---|---|
)";

std::string code(std::string_view text) { return text.empty() ? "" : fmt::format("`{}`", text); }

std::string words_text(std::string_view words) {
  std::string text;
  for (const std::string_view word : split_words(words))
    text += fmt::format("{}`\"{}\"`", text.empty() ? "" : ", ", word);
  return text;
}

std::string range(const StudyKey& key) {
  if (key.low <= -1e9 && key.high >= 1e9) return {};
  if (key.high >= 1e9) return fmt::format(" {} {:g}", key.low_excluded ? "over" : "from", key.low);
  return fmt::format(", {}{:g} to {:g}", key.low_excluded ? "over " : "", key.low, key.high);
}

std::string value_text(const StudyKey& key) {
  switch (key.type) {
    case ValueType::kTable:
      return "table";
    case ValueType::kTables:
      return "list of tables";
    case ValueType::kText:
      return "text";
    case ValueType::kTexts:
      return "text or list of texts";
    case ValueType::kWord:
      return words_text(key.words) + (key.later.empty() ? "" : "; ¹ " + words_text(key.later));
    case ValueType::kNumber:
      return "number" + range(key);
    case ValueType::kNumberOrWord:
      return "number" + range(key) + ", or " + words_text(key.words);
    case ValueType::kInteger:
      return "whole number" + range(key);
    case ValueType::kBoolean:
      return "`true` or `false`";
    case ValueType::kReflectance:
      return "number" + range(key) + ", or one a band";
    case ValueType::kShare:
      return "number" + range(key) + ", or per cent as text";
    case ValueType::kDates:
      return "date and time, or list of them";
    case ValueType::kNumbers:
      return "list of numbers";
    case ValueType::kNumbersOrWord:
      return "list of numbers, or " + words_text(key.words);
  }
  return {};
}

}  // namespace

std::string study_page() {
  std::string page(kOpening);
  for (const StudyKey& key : study_keys())
    page += fmt::format("| `{}`{} | {} | {} | {} | {} |\n", key.path, key.supported ? "" : " ¹", value_text(key),
                        key.unit, code(key.fallback), key.meaning);
  return page;
}

}  // namespace clerestory::io
