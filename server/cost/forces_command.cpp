#include "cost/forces_command.hpp"

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <variant>

#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "cost/bodies.hpp"
#include "cost/command.hpp"
#include "idl/option_checks.hpp"

namespace slod::cost {
namespace {

/// A line "ax ay az" for each body, in their order.
void write_accelerations(const std::filesystem::path& file, const std::vector<Vector3d>& accelerations)
{
    std::ofstream stream(file);
    for (const Vector3d& a : accelerations)
        stream << number_text(a.x()) << ' ' << number_text(a.y()) << ' ' << number_text(a.z()) << '\n';
    if (!stream.flush())
        throw std::runtime_error("cannot write " + file.string());
}

} // namespace

ForcesCommand::ForcesCommand(CLI::App& app)
    : command_(
          app.add_subcommand("forces", "Measure one evaluation of gravity between single particles (G = 1)"))
{
    command_
        ->add_option(
            "--model", model_,
            "plummer, clumps, disc, box, or a file: GADGET-2's, or text with a line \"x y z mass\" for each "
            "body")
        ->option_text("MODEL");
    command_->add_option("--n", count_, "Bodies of a model without a file; 100000")
        ->check(between<std::size_t>(1, 100'000'000))
        ->option_text("N");
    command_->add_option("--softening", softening_, "Plummer softening length; 0.01")
        ->check(between(0.0, 1e30))
        ->option_text("LENGTH");
    CLI::Option_group* const precision = command_->add_option_group(
        "precision", "One of these; without any of them, gravity's default settings");
    precision->add_option("--accuracy", accuracy_, "Median relative error to aim at")
        ->check(between(least_accuracy, most_accuracy))
        ->option_text("E");
    precision->add_option("--theta", theta_, "Opening angle of the geometric criterion")
        ->check(between(0.01, widest_opening))
        ->option_text("T");
    precision->add_option("--tolerance", tolerance_, "Force tolerance of the relative criterion")
        ->check(between(1e-9, 1.0))
        ->option_text("T");
    precision->require_option(0, 1);
    add_threads_option(*command_, threads_);
    command_->add_option("--repeats", repeats_, "Evaluations, of which times are medians; 5")
        ->check(between(1, 10'000))
        ->option_text("N");
    command_->add_option("--seed", seed_, "Of a model without a file; 1")
        ->check(at_least_zero<std::uint64_t>())
        ->option_text("N");
    command_->add_option("--accelerations", accelerations_, "Write them, a line \"ax ay az\" for each body")
        ->check(writable_file())
        ->option_text("FILE");
    command_->add_flag("--json", as_json_, "Print one JSON object instead");
    command_->footer("Errors are those of 2,000 bodies beside sums over all pairs in double.\n"
                     "Exit codes: 0 done, 1 failed, 2 wrong usage or file.");
}

int ForcesCommand::run() const
{
    const auto bodies = bodies_of(model_, count_, seed_);
    if (const auto* problems = std::get_if<Problems>(&bodies))
        return complain(*problems);
    ForceReport report;
    ThreadTeam(team_size(threads_)).run([&] { report = measure(std::get<ParticleSet>(bodies)); });
    std::printf("%s\n", as_json_ ? json_text(report).c_str() : text(report).c_str());
    return 0;
}

ForceReport ForcesCommand::measure(const ParticleSet& bodies) const
{
    GravitySettings gravity;
    gravity.accuracy = accuracy_;
    if (theta_ > 0) {
        gravity.opening = OpeningCriterion::Geometric;
        gravity.opening_angle = theta_;
    }
    if (tolerance_ > 0)
        gravity.force_tolerance = tolerance_;
    const double begin_ms = wall_milliseconds();
    ForceWorld world(bodies, softening_);
    const double tree_seconds = 1e-3 * (wall_milliseconds() - begin_ms);
    const ForceReport asked{.model = model_,
                            .bodies = bodies.size(),
                            .threads = team_size(threads_),
                            .softening = softening_,
                            .gravity = gravity,
                            .tree_seconds = tree_seconds};
    const ForceReport report =
        cost::measure(world, exact_forces(bodies, softening_), asked, repeats_, wall_milliseconds);
    if (!accelerations_.empty())
        write_accelerations(accelerations_, world.accelerations());
    return report;
}

} // namespace slod::cost
