#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "gui/panels/fly_panels.h"
#include "gui/panels/map_views.h"
#include "gui/panels/terrain_views.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"
#include "gui/widgets/site_row.h"

namespace palace {

namespace {

struct Row {
  std::uint64_t id = 0;
  std::string letter;
  const LandingSite* site = nullptr;  ///< null: no longer listed, its room is kept
};

/// What is listed: the sites, and before them the armed one where it is no longer among them: what
/// is about to be approved is never out of sight.
struct Rows {
  std::vector<Row> rows;
  std::optional<std::uint64_t> unlisted;  ///< the armed site, which the newest map does not offer
};

Rows RowsOf(const TerrainDecision* known, const MissionStatus& mission) {
  Rows listed;
  bool armed = false;
  if (known != nullptr) {
    for (const LandingSite& site : known->selection.sites) {
      listed.rows.push_back({site.id, site.letter, &site});
      armed = armed || (mission.armed && mission.armed->id == site.id);
    }
    // What the operator refused is no offer: it stays to be looked at again, below those that are.
    std::stable_partition(listed.rows.begin(), listed.rows.end(),
                          [&](const Row& row) { return !mission.IsRefused(row.id); });
  }
  if (mission.armed && !armed) {
    const LandingSite& site = mission.armed_now ? *mission.armed_now : *mission.armed;
    listed.unlisted = mission.armed->id;
    listed.rows.insert(listed.rows.begin(), {site.id, site.letter, &site});
  }
  return listed;
}

/// Leaves the rows where they lay. What is new takes the room of what is gone, but for the row
/// under the pointer, and comes last where there is none. True where the engine's list is another.
bool KeepOrder(const std::vector<SiteListState::Held>& held, std::size_t pointed,
               std::vector<Row>& rows) {
  std::vector<Row> kept, fresh = rows;
  for (const SiteListState::Held& before : held) {
    const auto now = std::find_if(fresh.begin(), fresh.end(),
                                  [&](const Row& row) { return row.id == before.id; });
    kept.push_back(now != fresh.end() ? *now : Row{before.id, before.letter, nullptr});
    if (now != fresh.end()) {
      fresh.erase(now);
    }
  }
  auto next = fresh.begin();
  for (std::size_t i = 0; i < kept.size() && next != fresh.end(); ++i) {
    if (kept[i].site == nullptr && i != pointed) {
      kept[i] = *next++;
    }
  }
  kept.insert(kept.end(), next, fresh.end());
  const bool is_other = !std::equal(kept.begin(), kept.end(), rows.begin(), rows.end(),
                                    [](const Row& a, const Row& b) { return a.site == b.site; });
  rows = std::move(kept);
  return is_other;
}

SiteRowLook LookOf(const LandingSite& site, bool unlisted, const MissionStatus& mission) {
  SiteRowLook look;
  look.selected = mission.armed && site.id == mission.armed->id;
  look.enabled = !unlisted && mission.MaySelect(site.id);
  look.refused = mission.IsRefused(site.id);
  if (look.selected && mission.armed_verdict != SiteVerdict::kHolds) {
    look.verdict = SiteVerdictWord(mission.armed_verdict);
    look.why = mission.armed_why;
  }
  if (unlisted && !mission.armed_now) {
    look.verdict = "Off the map";
  }
  return look;
}

void DrawEmpty(const EngineSnapshot& snap, const Rect& content, UiFrame& ui) {
  const Style& s = ui.style;
  const TerrainDecision* known = SitesInForce(snap);
  std::string text =
      NoMapWords(snap) +
      (snap.terrain->why_no_map.empty() ? ". Sites appear with the first stereo pairs." : ".");
  if (known == nullptr && snap.terrain->range && !snap.sensors->pose) {
    text = std::string("Attitude and height are unknown: ranges make no map. ") +
           (HasPicturesOnly(snap.session->role) ? "Add [pose] to RIG.toml."
                                                : "No vehicle pose came yet.");
  } else if (known != nullptr && known->selection.waits) {
    text = "No site listed yet: " + known->selection.none_reason + ".";
  } else if (known != nullptr && HasPicturesOnly(snap.session->role)) {
    text = "No site listed: " + known->selection.none_reason +
           ". Look at the maps to see which limit decides.";
  } else if (known != nullptr) {
    text = "No site listed: " + known->selection.none_reason +
           ". Fly on, or look at the maps to see which limit decides.";
  }
  float y = content.y + s.Px(20);
  for (const std::string& line : WrapText(s.body, text, content.w - s.Px(24))) {
    DrawText(ui, s.body, s.palette.text2, content.x + s.Px(12), y, line);
    y += s.Px(20);
  }
}

/// The rows as they are drawn: how high each is, and where the list lies.
struct ListView {
  Rect list;
  float row = 0;

  /// The scroll that is possible for so many rows, of whole rows; returns what lies beyond the
  /// list.
  float Scroll(float to, std::size_t count, SiteListState& state) const {
    const float beyond = std::max(0.0f, row * static_cast<float>(count) - list.h);
    state.scroll = std::clamp(std::round(to / row) * row, 0.0f, beyond);
    return beyond;
  }
};

Rect DrawHead(const EngineSnapshot& snap, const FlyLayout& layout, const SiteListState& state,
              std::size_t live, bool old, UiFrame& ui) {
  const TerrainDecision* known = SitesInForce(snap);
  const std::size_t found = known != nullptr ? known->selection.sites.size() : 0;
  const auto shown_rows = static_cast<std::size_t>(layout.site_rows);
  const bool preview = snap.terrain->preview != nullptr;
  const std::string found_words =
      std::to_string(found) + " found" +
      (live > shown_rows ? ", " + std::to_string(shown_rows) + " shown, wheel" : "");
  return DrawPanelFrame(
      ui, layout.sites, "Sites",
      {{old ? "Map " + AgeText(ShownMapAge(snap, ui.silent_s)) + " old" : "", 0, true, true},
       {preview ? "Applied, not the preview" : "", ui.style.palette.text1, true, false},
       {state.order_held ? "Order held under the pointer" : "", ui.style.palette.text1, true,
        false},
       {found_words},
       {live > 0 && !layout.narrow && !old && !preview ? "Tab for next" : ""}});
}

std::uint64_t ArmedId(const EngineSnapshot& snap) {
  const auto& armed = snap.flight->mission.armed;
  return armed ? armed->id : 0;
}

/// Puts the rows where they lay under the pointer, and the keyboard's row into sight; while neither
/// is at work, that of the armed site. Returns what lies beyond the list.
float ArrangeRows(const ListView& view, const Interaction& pointer, std::uint64_t armed,
                  SiteListState& state, std::vector<Row>& rows, UiFrame& ui) {
  if (!pointer.hovered) {
    state.drawn.clear();
  }
  // The rows that are held are never fewer than were drawn, so that the scroll of the row under the
  // pointer is known before.
  view.Scroll(state.scroll - pointer.wheel * view.row, std::max(rows.size(), state.drawn.size()),
              state);
  const float pointed = std::max(0.0f, pointer.pointer.y - view.list.y + state.scroll) / view.row;
  state.order_held = KeepOrder(state.drawn, static_cast<std::size_t>(pointed), rows);
  state.drawn.clear();
  for (const Row& one : rows) {
    state.drawn.push_back({one.id, one.letter});
  }
  const auto show = [&](std::size_t i) {
    const float top = view.row * static_cast<float>(i);
    state.scroll = std::clamp(state.scroll, top + view.row - view.list.h, top);
  };
  bool by_keys = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool focused = rows[i].site != nullptr && ui.focus.Has(SiteItemName(rows[i].letter));
    by_keys = by_keys || focused;
    if (focused && ui.focus.shown() != state.followed) {
      show(i);
    }
  }
  for (std::size_t i = 0; i < rows.size() && !pointer.hovered && !by_keys; ++i) {
    if (armed != 0 && rows[i].id == armed) {
      show(i);  // what is about to be approved, or flown to, is not scrolled out of sight
    }
  }
  state.followed = ui.focus.shown();
  return view.Scroll(state.scroll, rows.size(), state);
}

/// The whole picture, of which each row shows its part.
std::optional<PictureView> WholePicture(const EngineSnapshot& snap) {
  const auto camera = LeftCamera(snap);
  if (!camera) {
    return std::nullopt;
  }
  return PictureView{*camera,
                     snap.sensors->X_WC,
                     {0, 0, static_cast<float>(camera->width), static_cast<float>(camera->height)}};
}

/// Draws the rows in sight. Returns the site of the row under the pointer or the keyboard; 0: none.
std::uint64_t DrawRows(const EngineSnapshot& snap, const ListView& view, const SiteListState& state,
                       const Rows& listed, const SiteRowLook& all, UiFrame& ui) {
  const Style& s = ui.style;
  const MissionStatus& mission = snap.flight->mission;
  const TerrainDecision* known = SitesInForce(snap);
  const LandingSite* best =
      known != nullptr ? mission.BestStanding(known->selection.sites) : nullptr;
  const std::optional<PictureView> picture = WholePicture(snap);
  const auto first = static_cast<int>(state.scroll / view.row);
  const auto end = first + static_cast<int>(std::round(view.list.h / view.row));
  std::uint64_t focused = 0;
  for (int i = 0; i < static_cast<int>(listed.rows.size()); ++i) {
    const Row& row = listed.rows[static_cast<std::size_t>(i)];
    const bool in_sight = i >= first && i < end;
    const Rect rect{view.list.x, view.list.y + view.row * static_cast<float>(i - first),
                    view.list.w, view.row};
    if (row.site == nullptr) {
      if (in_sight) {
        DrawText(ui, s.body, s.palette.text3, rect.x + s.Px(16), rect.centre().y,
                 row.letter + " is no longer listed");
      }
      continue;
    }
    const LandingSite& site = *row.site;
    if (!in_sight) {
      OfferHidden(ui, SiteItemName(site.letter));
      continue;
    }
    SiteRowLook look = LookOf(site, site.id == listed.unlisted, mission);
    look.narrow = all.narrow;
    look.old_map = all.old_map;
    look.standing = StandingOf(site, snap.session->settings.slad);
    look.standing_words = StandingWords(site, snap.session->settings.slad);
    const SiteRowAnswer answer =
        DrawSiteRow(ui, rect, site, picture, ui.textures.left_camera, look);
    focused = answer.focused ? site.id : focused;
    if (answer.clicked) {
      ui.intents.push_back(CommandAction(SelectSite{site.id}));
    }
    if (&site == best) {
      // Letters stay with places, so scripts need a name for whatever leads.
      ui.items.Add("site/best", rect, look.enabled, site.letter);
    }
  }
  return focused;
}

void DrawScrollBar(const ListView& view, const SiteListState& state, float beyond, UiFrame& ui) {
  if (beyond > 0) {
    const Style& s = ui.style;
    const Rect& list = view.list;
    const float share = list.h / (list.h + beyond);
    FillRect(Canvas(),
             {list.right() - s.Px(6), list.y + state.scroll * share, s.Px(4), list.h * share},
             s.palette.strong_line, s.Fine(2));
  }
}

}  // namespace

void DrawSiteListPanel(const EngineSnapshot& snap, const FlyLayout& layout, SiteListState& state,
                       UiFrame& ui) {
  const Style& s = ui.style;
  Rows listed = RowsOf(SitesInForce(snap), snap.flight->mission);
  const bool none = listed.rows.empty();
  const bool old = !none && IsMapOld(snap, ui.silent_s);
  const Rect content = DrawHead(snap, layout, state, listed.rows.size(), old, ui);
  const float row = s.Px(static_cast<float>(layout.site_row_units));
  const ListView view{{content.x, content.y + s.Px(layout.narrow ? 2 : 4), content.w,
                       row * static_cast<float>(layout.site_rows)},
                      row};
  const Interaction pointer = Interact(ui, "panel/Sites", view.list, kPassive);
  std::uint64_t focused = 0;
  if (none) {
    DrawEmpty(snap, content, ui);
  } else {
    const float beyond = ArrangeRows(view, pointer, ArmedId(snap), state, listed.rows, ui);
    SiteRowLook all;
    all.narrow = layout.site_row_units < 60;
    all.old_map = old;
    focused = DrawRows(snap, view, state, listed, all, ui);
    DrawScrollBar(view, state, beyond, ui);
  }
  if (focused != ui.highlighted_site) {
    ui.intents.push_back(UiAction(HighlightSite{focused}));
  }
}

}  // namespace palace
