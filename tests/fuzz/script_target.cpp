#include "gui/app/script.h"
#include "tests/fuzz/fuzz_target.h"

namespace palace {

FuzzTarget ScriptTarget() {
  return {"script", [](Bytes input) { (void)ParseScript(AsText(input), "script.txt"); }};
}

}  // namespace palace
