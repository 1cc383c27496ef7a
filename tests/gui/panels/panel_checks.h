// Checks that every workspace passes: no text leaves its panel, no two texts touch.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gui/widgets/ui_frame.h"

namespace palace {

inline bool Inside(const Rect& inner, const Rect& outer, float slack = 0.5f) {
  return inner.x >= outer.x - slack && inner.y >= outer.y - slack &&
         inner.right() <= outer.right() + slack && inner.bottom() <= outer.bottom() + slack;
}

inline bool Touch(const Rect& a, const Rect& b) {
  return a.x < b.right() && b.x < a.right() && a.y + 3 < b.bottom() - 3 && b.y + 3 < a.bottom() - 3;
}

/// Some text on the screen has this in it.
inline bool HasText(const ItemRecord& items, const std::string& part) {
  return std::any_of(items.items().begin(), items.items().end(), [&](const Item& item) {
    return item.name == "text" && item.text.find(part) != std::string::npos;
  });
}

/// Every text lies in some panel, and in no two texts' way.
inline void ExpectTextsInPanels(const ItemRecord& items) {
  std::vector<const Item*> texts, panels;
  for (const Item& item : items.items()) {
    if (item.name == "text" && item.rect.w > 0) {
      texts.push_back(&item);
    } else if (item.name.rfind("panel/", 0) == 0) {
      panels.push_back(&item);
    }
  }
  EXPECT_GT(texts.size(), 10U);
  for (const Item* text : texts) {
    bool inside = false;
    for (const Item* panel : panels) {
      inside = inside || Inside(text->rect, panel->rect, 1.5f);
    }
    EXPECT_TRUE(inside) << "'" << text->text << "' at " << text->rect.x << "," << text->rect.y
                        << " to " << text->rect.right() << "," << text->rect.bottom();
  }
  for (std::size_t i = 0; i < texts.size(); ++i) {
    for (std::size_t j = i + 1; j < texts.size(); ++j) {
      EXPECT_FALSE(Touch(texts[i]->rect, texts[j]->rect))
          << "'" << texts[i]->text << "' touches '" << texts[j]->text << "' at " << texts[i]->rect.x
          << "," << texts[i]->rect.y;
    }
  }
}

/// No panel covers another: each pair is apart.
inline void ExpectPanelsApart(const ItemRecord& items, const Rect& body) {
  std::vector<const Item*> panels;
  for (const Item& item : items.items()) {
    if (item.name.rfind("panel/", 0) == 0) {
      panels.push_back(&item);
      EXPECT_TRUE(Inside(item.rect, body, 1)) << item.name;
    }
  }
  for (std::size_t i = 0; i < panels.size(); ++i) {
    for (std::size_t j = i + 1; j < panels.size(); ++j) {
      const Rect& a = panels[i]->rect;
      const Rect& b = panels[j]->rect;
      EXPECT_FALSE(a.x + 1 < b.right() && b.x + 1 < a.right() && a.y + 1 < b.bottom() &&
                   b.y + 1 < a.bottom())
          << panels[i]->name << " covers " << panels[j]->name;
    }
  }
}

inline Rect BodyOf(float width, float height) { return {8, 88, width - 16, height - 124}; }

struct WindowSize {
  const char* name;
  float width, height;
};
inline const WindowSize kWindowSizes[] = {{"1280x720", 1280, 720},
                                          {"1366x768", 1366, 768},
                                          {"1600x900", 1600, 900},
                                          {"1920x1080", 1920, 1080},
                                          {"2560x1440", 2560, 1440}};

}  // namespace palace
