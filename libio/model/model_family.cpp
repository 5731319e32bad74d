#include "libio/model/model_family.hpp"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <utility>

#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/system/scene_beside.hpp"
#include "libio/model/config.hpp"
#include "libio/model/model_builder.hpp"
#include "libio/model/model_table.hpp"

namespace whirl::inline io {

namespace {

constexpr std::size_t remembered = 4;  ///< scenes; a difference of an equation asks for two

/// The table that a path is in; null: it is at the top of the file.
const ModelTable* table_of(const std::string& path) {
  const std::vector<ModelTable>& all = model_tables();
  const auto table = std::ranges::find(all, path.substr(0, path.find('.')), &ModelTable::name);
  return table == all.end() ? nullptr : &*table;
}

bool same_place(const Station& a, const Station& b) {
  return a.kind == b.kind && a.z == b.z && a.node == b.node && a.body == b.body;
}

/// Whether the contacts and films of two models act on the same coordinates of the same rotor.
bool same_ports(const Model& a, const Model& b) {
  const auto same_contact = [](const Contact& x, const Contact& y) {
    return same_place(x.at, y.at) && same_place(x.against, y.against) &&
           geometry_of(x).index() == geometry_of(y).index();
  };
  const auto same_film = [](const OilFilm& x, const OilFilm& y) {
    return same_place(x.at, y.at) && same_place(x.against, y.against) &&
           spring_of(x.law) == spring_of(y.law);
  };
  return std::ranges::equal(a.contacts, b.contacts, same_contact) &&
         std::ranges::equal(a.films, b.films, same_film);
}

}  // namespace

struct ModelFamily::State {
  std::shared_ptr<const Model> base;
  std::vector<ParameterAxis> axes;
  ConfigNode root;
  NamedFiles files;            ///< none: the model has its tables in it
  std::vector<bool> of_rotor;  ///< per axis, whether its value is in one of the rotor's tables
  /// No value is in a table of the rotor, or of a film, about whose equilibrium modes are.
  bool same_modes = true;

  struct Known {
    std::vector<double> values;
    std::shared_ptr<const Scene> scene;
  };
  /// A model whose rotor was read from these values of the axes that are `of_rotor`.
  struct ReadRotor {
    std::vector<double> values;
    std::shared_ptr<const Model> model;
  };
  std::mutex mutex;
  /// Trees that members were read from. The values of the next member take the place of theirs,
  /// which is less than a copy of the whole tree.
  std::vector<ConfigNode> trees;
  ReadRotor rotor;                          ///< the last one
  std::shared_ptr<const Scene> foundation;  ///< of the last member that was assembled or reduced
  std::deque<Known> last;
  struct KnownModes {
    double Omega = 0.0;
    int count = 0;
    Modes modes;
  };
  std::shared_ptr<const KnownModes> modes;  ///< of the last start
};

/// A tree of the family for as long as a member is read from it.
class ModelFamily::Tree {
 public:
  explicit Tree(State& family) : family_(family) {
    const std::lock_guard lock(family.mutex);
    if (family.trees.empty()) {
      root = family.root;
    } else {
      root = std::move(family.trees.back());
      family.trees.pop_back();
    }
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
  ~Tree() {
    const std::lock_guard lock(family_.mutex);
    family_.trees.push_back(std::move(root));
  }

  ConfigNode root;

 private:
  State& family_;
};

ModelFamily::ModelFamily(const Model& base, std::vector<ParameterAxis> axes)
    : state_(std::make_unique<State>()) {
  state_->base = std::make_shared<const Model>(base);
  state_->axes = std::move(axes);
  state_->root = parse_toml(base.source, base.path);
  state_->files = NamedFiles::none_in(std::filesystem::path(base.path).parent_path());
  for (const ParameterAxis& axis : state_->axes) {
    bool is_of_rotor = false;
    for (const std::string& path : axis.paths()) {
      const ModelTable* const table = table_of(path);
      const bool is_light = table && !table->is_of_rotor;
      is_of_rotor = is_of_rotor || !is_light;
      state_->same_modes = state_->same_modes && is_light && table->name != "oil_film";
    }
    state_->of_rotor.push_back(is_of_rotor);
  }
  const bool has_one_rotor = std::ranges::none_of(state_->of_rotor, std::identity());
  if (has_one_rotor) state_->rotor.model = state_->base;
}

ModelFamily::~ModelFamily() = default;
ModelFamily::ModelFamily(ModelFamily&&) noexcept = default;
ModelFamily& ModelFamily::operator=(ModelFamily&&) noexcept = default;

Model ModelFamily::model(std::span<const double> values) const {
  Tree tree(*state_);
  ConfigNode& root = tree.root;
  std::vector<double> of_rotor;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (state_->of_rotor[i]) of_rotor.push_back(values[i]);
    for (const std::string& set : state_->axes[i].assignments_of(values[i])) set_value(root, set);
  }
  std::shared_ptr<const Model> on;
  {
    const std::lock_guard lock(state_->mutex);
    if (state_->rotor.values == of_rotor) on = state_->rotor.model;
  }
  Model member;
  if (on) member = ModelBuilder(root, state_->files).rebuild(*on);
  if (!on || !same_ports(member, *on)) {
    member = ModelBuilder(root, state_->files).build();
    if (!of_rotor.empty()) {
      auto read = std::make_shared<const Model>(member);
      const std::lock_guard lock(state_->mutex);
      state_->rotor = {std::move(of_rotor), std::move(read)};
    }
  }
  member.source = state_->base->source;
  member.path = state_->base->path;
  return member;
}

std::shared_ptr<const Scene> ModelFamily::scene(const Model& member) const {
  const auto made_on = [&](Assembler assembler) {
    return std::make_shared<const Scene>(
        make_scene(std::move(assembler), member, ReductionEstimate::no));
  };
  const bool is_comparable =
      member.reduction == state_->base->reduction && same_ports(member, *state_->base);
  if (!is_comparable) return made_on(Assembler(member.structure));
  std::shared_ptr<const Scene> on;
  {
    const std::lock_guard lock(state_->mutex);
    on = state_->foundation;
  }
  if (on) {
    if (auto beside = scene_beside(*on, member)) return beside;
  }
  auto assembler = on ? on->assembler.with_loads_of(member.structure) : std::nullopt;
  on = made_on(assembler ? *std::move(assembler) : Assembler(member.structure));
  const std::lock_guard lock(state_->mutex);
  state_->foundation = on;
  return on;
}

std::shared_ptr<const Scene> ModelFamily::scene(std::span<const double> values) const {
  const auto is_it = [&](const State::Known& known) {
    return std::equal(known.values.begin(), known.values.end(), values.begin(), values.end());
  };
  {
    const std::lock_guard lock(state_->mutex);
    const auto known = std::find_if(state_->last.begin(), state_->last.end(), is_it);
    if (known != state_->last.end()) return known->scene;
  }
  auto made = scene(model(values));
  const std::lock_guard lock(state_->mutex);
  state_->last.push_front({{values.begin(), values.end()}, made});
  if (state_->last.size() > remembered) state_->last.pop_back();
  return made;
}

MotionState ModelFamily::start(const Model& member, const Scene& scene,
                               const FullState* end) const {
  const int count = modes_of(member.start);
  if (count == 0 || !state_->same_modes) return start_state(member, scene, end);
  std::shared_ptr<const State::KnownModes> known;
  {
    const std::lock_guard lock(state_->mutex);
    known = state_->modes;
  }
  if (!known || known->Omega != member.speed || known->count != count) {
    known = std::make_shared<const State::KnownModes>(
        State::KnownModes{member.speed, count, linear_modes(member, scene, count)});
    const std::lock_guard lock(state_->mutex);
    state_->modes = known;
  }
  return start_state(member, scene, end, known->modes);
}

}  // namespace whirl::inline io
