#include "hal/linux/interface_look.hpp"

#include "hal/linux/interface_facts.hpp"

namespace ivo::hal {

void InterfaceLook::once() {
  handover_.close_discarded();
  handover_.begin_look();
  const LinkAnswer answer = ask_for_link(name_);
  if (answer.outcome == LinkAnswer::Outcome::kNotTold) {
    return;
  }
  const InterfaceFacts& facts = answer.facts;
  LinkReport report;
  report.present = answer.outcome == LinkAnswer::Outcome::kFound && facts.carries_can;
  if (report.present && !check_bit_rate(facts, bit_rate_bps_)) {
    report.present = false;
    index_ = 0;  // once it is right, a new socket tells the loop so
  }
  report.up = facts.up;
  report.controller = facts.controller;
  report.counts_errors = facts.counts_errors;
  report.transmit_errors = facts.transmit_errors;
  report.receive_errors = facts.receive_errors;
  if (report.present && facts.index != index_) {
    Result<CanSocket> opened = open_can_socket(name_, options_);
    if (!opened) {
      report.present = false;  // not up yet, say: the socket that there is belongs to the old one
    } else {
      index_ = opened.value().index;
      handover_.offer(std::move(opened.value().socket));
    }
  }
  handover_.report(report);
}

}  // namespace ivo::hal
