#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>

#include "cost/command.hpp"
#include "cost/forces_command.hpp"
#include "cost/paper_command.hpp"
#include "cost/scene_command.hpp"
#include "idl/version.hpp"

int main(int argc, char** argv)
try {
    using namespace slod;
    CLI::App app(
        "What accuracy costs in time: of a whole scene, at many settings beside the unclustered run; of "
        "one evaluation of gravity; or of the paper's two simulations.\n"
        "Example: slod-cost scene config/scenes/galaxy.toml --quick --out cost\n"
        "Example: slod-cost forces --model plummer --n 100000 --accuracy 0.001");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string(version()));
    cost::SceneCommand scene(app);
    cost::ForcesCommand forces(app);
    cost::PaperCommand paper(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : cost::wrong;
    }
    return scene.chosen() ? scene.run() : forces.chosen() ? forces.run() : paper.run();
} catch (const std::exception& error) {
    std::fprintf(stderr, "slod-cost: %s\n", error.what());
    return slod::cost::failed;
}
