// SPDX-License-Identifier: Apache-2.0
#include "bus_face.hpp"

namespace rave::runtime {

Result<std::unique_ptr<BusFace>> BusFace::open(bus::Bus& bus, std::uint32_t host, bool obstacles,
                                               plugin::Catalogue* catalogue) {
  std::unique_ptr<BusFace> face(new BusFace());
  onlook::Teller::Options options{host, obstacles, {}, catalogue};
  options.words = [self = face.get()](const sim::Event& event) {
    return self->kinds_ == nullptr ? event.text : words_of(*self->kinds_, event);
  };
  RAVE_TRY_ASSIGN(auto teller, onlook::Teller::create(bus, std::move(options)));
  face->teller_ = std::make_unique<onlook::Teller>(std::move(teller));
  return face;
}

Status BusFace::run_begins(const RunView& run) {
  kinds_ = &run.kinds;
  teller_->begin(run.engine.spec());
  return {};
}

void BusFace::after_step(const StepView& step) {
  teller_->after_step(step.engine, step.beside, step.late);
}

void BusFace::held(const sim::Engine& engine) { teller_->held(engine); }

}  // namespace rave::runtime
