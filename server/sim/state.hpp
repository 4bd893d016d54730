#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>

#include "cluster/forming.hpp"
#include "effects/air.hpp"
#include "effects/collisions.hpp"
#include "effects/draining.hpp"
#include "effects/emission.hpp"
#include "effects/field_forces.hpp"
#include "effects/member_kicks.hpp"
#include "gravity/force_view.hpp"
#include "gravity/forces.hpp"
#include "sim/error_meter.hpp"
#include "sim/simulation.hpp"
#include "simd/kernels.hpp"
#include "tree/expire.hpp"
#include "tree/reforming.hpp"
#include "tree/regrouping.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// What the simulation consists of, and its phases.
struct Simulation::State {
    /// What there is at the start besides particles.
    struct Start {
        SlodTree tree; ///< without clusters
        std::uint64_t frame = 0;
        std::uint64_t formations = 0;  ///< of clusters so far
        std::uint32_t generations = 0; ///< that clusters' slots have had, at most
    };

    State(const SimulationSettings& wanted, const ParticleSet& initial, const Options& options);
    State(const SimulationSettings& wanted, const ParticleSet& initial, const Options& options, Start start);

    /// The same particles, regions and time under a plan for other effects.
    std::unique_ptr<State> with(const SimulationSettings& wanted, const ParticleSet& particles) const;

    /// Commands: recycles member slabs, lets changes of regions and of forces count, makes room, and counts
    /// the frame that begins.
    void open(const Request& request);
    void form_clusters(const ParticleSet& particles);
    void make_room();   ///< Provides memory for the frame, so that no other phase but emit has to take any
    void look_around(); ///< Moments and forces of the clusters as they are, outside their phases
    /// Chooses the length of the next sub-step; false: it is the frame's last one.
    bool begin_substep();
    void kick();
    void close_kick();
    void propagate();
    /// Takes out what has left the range of numbers, of members counted at the end of that frame.
    void take_out_unsound(std::uint64_t counted);
    void turn_wind(); ///< Takes this frame's wind, where that is the same everywhere
    void expire();
    void drain();
    void emit();
    void update();
    void measure_moments();
    void evaluate_forces();
    void evaluate_gravity();
    void observe(const Request& request);
    void sample(const Request& request); ///< Goes on measuring errors
    void compare(ErrorMeter::Drawn& drawn) const;
    Vector3d air_at(const Vector3d& x, const Vector3d& v) const;
    Vector3d air_by_cluster(std::size_t slot, const Vector3d& away, const Vector3d& v) const;
    double potential_energy() const;
    void count_regions();
    void copy_clusters();

    std::optional<RegionRow> find_region(std::string_view name) const;
    void check_sharing(const RegionOfInterest& region, Problems& found) const;
    void take(const SimulationSettings& wanted);
    void scale_pulls(double factor);
    void set_fields();   ///< Those that are the same everywhere, from the settings
    void place_fields(); ///< Then those of places
    void set_detail();   ///< from the settings and the tree's detail

    /// Adds the milliseconds that work takes to a sum.
    template <class Work>
    void timed(double& ms, const Work& work)
    {
        ms += double(nanoseconds_of(tick, work)) * 1e-6;
    }

    /// Runs and times a phase, if the plan has it.
    template <class Work>
    void run(Phase phase, const Work& work)
    {
        if (plan.has(phase))
            timed(snapshot.profile[phase], work);
    }

    double time() const ///< at the end of the frame, or of the sub-step within it
    {
        return double(frame) * settings.time.step - time_left;
    }
    EffectWork& work_of(std::string_view effect) { return snapshot.effects[effect_row(effect)]; }

    /// Takes what a list of effects of place did, whose first is the `first` of all.
    template <class Counts, class Times>
    void note(const Counts& counts, const Times& times_ns, std::size_t first)
    {
        for (std::size_t i = 0; i < counts.size(); ++i) {
            snapshot.counts.fields[first + i] += counts[i];
            snapshot.counts.fields[first + i].straddling = counts[i].straddling; // as the frame leaves it
            EffectWork& work = snapshot.effects[first_field_effect + first + i];
            work.clusters = counts[i].clusters;
            work.straddling = counts[i].straddling;
            work.ms += double(times_ns[i]) * 1e-6;
        }
    }
    void note_effects(); ///< what the others did

    UpdateContext context() { return {store, frame, settings.time.step}; }
    FieldSource field_source() const { return {settings.seed, &kernels->waves}; }
    Problems problems() const;

    SimulationSettings asked;    ///< as they were given
    SimulationSettings settings; ///< what is called for of them
    Plan plan;
    const simd::KernelTable* kernels;
    Tick tick;
    GravitySettings gravity; ///< at the tree's detail, if the scene has gravity
    double gravitational_constant;
    UniformFields fields;
    Propagator propagator; ///< of one sub-step
    double range;          ///< of places: scene_range()
    double substep;        ///< time of one; of the frame, where that is not cut
    double time_left = 0;  ///< of the frame, after the present sub-step
    std::uint32_t substeps_left = 1;
    std::uint64_t frame = 0; ///< frames completed, or being completed within a step

    ClusterStore store;
    SlodTree tree;
    Reforming reforming;
    Regrouping regrouping;
    Expiry expiry;
    std::optional<Air> air;                  ///< where it is more than uniform fields
    std::optional<Collisions> collisions;    ///< where there are colliders
    std::optional<MemberKicks> member_kicks; ///< where particles are changed by themselves
    std::optional<Draining> draining;        ///< where there are sinks
    Emission emission;
    ForceView view;
    ForceLists force_lists;
    std::optional<FieldForces> field_forces; ///< where accelerations depend on the place

    ErrorMeter meter;

    std::vector<ClusterSlot> unsound; ///< memory of quarantine()
    bool metering = false;            ///< errors are asked for in this frame
    bool forces_stale = false;        ///< a setting of them changed since they were evaluated
    std::uint64_t particle_count = 0;
    Snapshot snapshot;
};

} // namespace slod
