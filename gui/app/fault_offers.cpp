#include "gui/app/fault_offers.h"

#include <cctype>

#include "engine/faults/fault_text.h"

namespace palace {
namespace {

/// With a capital.
std::string Sentence(std::string words) {
  words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words;
}

}  // namespace

std::vector<FaultOffer> FaultsOffered() {
  std::vector<FaultOffer> offers;
  for (const FaultKindRow& row : FaultKindTable()) {
    FaultOffer offer{
        .name = row.name, .words = Sentence(FaultKindWords(row.kind)), .what = row.what};
    offer.has_value = !std::isnan(row.default_value);
    offer.unit = row.unit;
    offer.default_value = row.default_value;
    offer.least = row.least;
    offer.most = row.most;
    for (const ChannelId id : ChannelsOf(row.kind)) {
      offer.channels.push_back({FaultChannelName(id), ChannelName(id)});
    }
    offers.push_back(std::move(offer));
  }
  return offers;
}

std::vector<ListedFault> ListFaults(const FaultInjector& injector) {
  std::vector<ListedFault> listed;
  for (const InjectedFault& each : injector.Faults()) {
    listed.push_back({each.number, Sentence(FaultWords(each.fault)),
                      Sentence(FaultKindWords(each.fault.kind)), each.fault.from_s, each.fault.to_s,
                      each.acts, each.over});
  }
  return listed;
}

Status Inject(FaultInjector& injector, const std::string& text) {
  const Result<Fault> fault = ParseFault(text);
  if (!fault) {
    return fault.error();
  }
  const Result<int> number = injector.AddFromNow(*fault);
  return number ? Ok() : Status(number.error());
}

}  // namespace palace
