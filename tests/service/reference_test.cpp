// What editors show comes from the reference: there is a text for everything that it should have.
#include "service/reference.hpp"

#include <doctest/doctest.h>

#include <string>

#include "lang/builtins.hpp"
#include "lang/objects.hpp"
#include "lang/settings.hpp"

using crt::service::Reference;

TEST_CASE("each built-in, constant and keyword has its text in the reference") {
  const Reference reference(crt::service::reference_text());
  for (const crt::lang::Builtin& builtin : crt::lang::builtins()) {
    CAPTURE(builtin.name);
    CHECK_FALSE(reference.word(builtin.name).empty());
  }
  for (const char* word :
       {"pi",        "t",      "Settings", "Scene", "Macro",  "import", "while",
        "for",       "in",     "if",       "else",  "elif",   "return", "scale",
        "translate", "rotate", "material", "id",    "matrix", "shadow", "visible"}) {
    CAPTURE(word);
    CHECK_FALSE(reference.word(word).empty());
  }
  CHECK(reference.word("nothing").empty());
}

TEST_CASE("each attribute of settings and camera has its text, and so have the lights' common") {
  const Reference reference(crt::service::reference_text());
  for (const char* name : {"width", "gamma", "targeterror", "projection"})
    CHECK_FALSE(reference.attribute("Settings", name).empty());
  for (const crt::lang::AttributeType& attribute :
       crt::lang::find_object_type("Camera")->attributes) {
    CAPTURE(attribute.name);
    CHECK_FALSE(reference.attribute("Camera", attribute.name).empty());
  }
  for (const char* name : {"color", "ambient", "falloff"})
    CHECK_FALSE(reference.attribute("PointLight", name).empty());
  CHECK_FALSE(reference.attribute("Checker", "scale").empty());
  for (const char* name : {"shadow", "visible"})
    CHECK_FALSE(reference.attribute("Sphere", name).empty());
}

TEST_CASE("modifiers may stand in a table of their own, within a list") {
  const Reference reference(
      "## Expressions\n\n- **Modifiers** make:\n\n  | modifier | operand | the new entity |\n"
      "  | --- | --- | --- |\n  | `id` | an Integer | numbered |\n");
  CHECK(reference.word("id") == "`<id>` with an Integer: numbered");
}

TEST_CASE("rows, notes, paragraphs and what sections share are brought together") {
  const Reference reference(
      "## Objects\n\n### Things\n\nAll have a `size`. Some have [links](#a).\n\n#### Thing\n\n"
      "Goes\non.\n\n| attribute | type | default | meaning and range |\n| --- | --- | --- | --- |\n"
      "| `size` | Float | required | |\n| `way` | Float | `0` | a \\| b, see below |\n\n"
      "- **`way`**: more\n  of it.\n\n```crt\nThing { }\n```\n\nAnd [so](b.md) on.\n");
  CHECK(reference.object("Thing") == "Goes on.\n\nAnd so on.");
  CHECK(reference.attribute("Thing", "size") == "All have a `size`.");
  CHECK(reference.attribute("Thing", "way") == "a | b, see below\n\n**`way`**: more of it.");
  CHECK(reference.object("Things").empty());
  CHECK(reference.attribute("Thing", "none").empty());
}
