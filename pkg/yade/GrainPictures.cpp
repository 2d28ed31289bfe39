// SPDX-License-Identifier: GPL-2.0-or-later
#include "GrainPictures.hpp"

#include "SoftGrain.hpp"
#include "SoftIntegrator.hpp"
#include "SoftState.hpp"

#include <functional>
#include <map>

namespace yade {

namespace {
    using Place = GrainPicture::Place;
    constexpr std::chrono::milliseconds patience {
        20
    }; // with a step that runs; the view renews itself some 20 times a second

    /// A function that gives a measure of each of what another gives.
    template <class Items, class Measure> auto each(Items (softgrain::Grain<2>::*items)() const, const Measure& measure)
    {
        return [=](const SoftState& state) {
            std::vector<Real> values;
            for (const auto& item : (state.grain.*items)())
                values.push_back(measure(item));
            return values;
        };
    }

    std::vector<Real> displacements(const SoftState& state)
    {
        const auto begin = state.referencePlaces(), now = state.grain.point_positions();
        std::vector<Real> values;
        for (size_t p = 0; p < now.size(); ++p)
            values.push_back((now[p] - begin[p]).norm());
        return values;
    }

    using Grain = softgrain::Grain<2>;
    using Stress = softgrain::Mat<3>;
    using Gradient = softgrain::Mat<2>;

    Real vonMises(const Stress& stress)
    {
        return std::sqrt(1.5) * (stress - stress.trace() / 3 * Stress::Identity()).norm();
    }

    /// Of each field the function that gives its values at the material points.
    const std::map<std::string, std::function<std::vector<Real>(const SoftState&)>> fields {
        { "J", each(&Grain::deformation_gradients, [](const Gradient& F) { return F.determinant(); }) },
        { "stretch",
          each(&Grain::deformation_gradients, [](const Gradient& F) { return F.jacobiSvd().singularValues()[0]; }) },
        { "pressure", each(&Grain::cauchy_stresses, [](const Stress& stress) { return -stress.trace() / 3; }) },
        { "vonMises", each(&Grain::cauchy_stresses, vonMises) },
        { "velocity", each(&Grain::point_velocities, [](const Place& velocity) { return velocity.norm(); }) },
        { "displacement", displacements },
        { "plasticStrain", [](const SoftState& state) { return state.grain.plastic_strains(); } },
    };

    constexpr Real spread = 1.16; // 2 / sqrt(3): in a full cell points are Gauss's, and their tiles meet in its middle

    void addTiles(GrainPicture& picture, const softgrain::Grain<2>& grain, const softgrain::Mat<2>& back)
    {
        const auto F = grain.deformation_gradients();
        for (size_t p = 0; p < F.size(); ++p) {
            const Real half = spread * std::sqrt(grain.mesh->point_volume[p]) * grain.radius / 2;
            const Place along = half * (back * F[p]).col(0), across = half * (back * F[p]).col(1),
                        &middle = picture.points[p];
            picture.tiles.push_back(
                { middle - along - across, middle + along - across, middle + along + across, middle - along + across });
        }
    }

    /// Of a grain that runs. The frame is that of the body as it is now, so that a picture that is shown late moves with it.
    GrainPicture taken(SoftState& state, const std::string& field)
    {
        GrainPicture picture;
        state.grain.pull();
        const softgrain::Mat<2> back = state.ori.conjugate().toRotationMatrix().topLeftCorner<2, 2>();
        const Place centre = state.pos.head<2>();
        const auto& surface = state.surface();
        for (int i = 0; i < surface.count; ++i)
            picture.outline.push_back(back * (Place(surface.position[2 * i], surface.position[2 * i + 1]) - centre));
        for (const Place& point : state.grain.point_positions())
            picture.points.push_back(back * (point - centre));
        if (const auto known = fields.find(field); known != fields.end()) picture.values = known->second(state);
        if (!picture.values.empty()) addTiles(picture, state.grain, back);
        return picture;
    }

    /// Of a grain before its first step; without an outline where its shape makes no sense, of which the step will tell.
    GrainPicture undeformed(SoftGrain& shape)
    {
        GrainPicture picture;
        try {
            const Real radius = shape.equivalentRadius();
            for (const auto& point : shape.mesh()->surface)
                picture.outline.push_back(radius * point.position);
            for (const auto& point : shape.mesh()->point_position)
                picture.points.push_back(radius * point);
        } catch (const softgrain::UserError&) {
        }
        return picture;
    }

    SoftIntegrator::Pause pauseOf(const Scene& scene)
    {
        for (const auto& engine : scene.engines)
            if (const auto* integrator = dynamic_cast<const SoftIntegrator*>(engine.get()))
                return integrator->pause(patience);
        return {};
    }
} // namespace

std::string GrainPictures::objection(const std::string& field)
{
    if (field.empty() || fields.count(field)) return {};
    std::string sentence = "field = '" + field + "' is none: take ";
    for (const auto& known : fields)
        sentence += "'" + known.first + "', ";
    return sentence + "or '' for the colours of shapes.";
}

const GrainPicture* GrainPictures::of(const State& state, const Scene& scene, const std::string& field)
{
    auto found = kept_.find(&state);
    if (found == kept_.end() || found->second.shown) {
        renew(scene, field);
        found = kept_.find(&state);
    }
    if (found == kept_.end()) return nullptr;
    found->second.shown = true;
    return &found->second.picture;
}

void GrainPictures::renew(const Scene& scene, const std::string& field)
{
    for (auto& entry : kept_)
        entry.second.shown = false;
    const SoftIntegrator::Pause pause = pauseOf(scene);
    if (pause.mutex() && !pause.owns_lock()) return; // a long step: the old ones once more
    const std::lock_guard lock(SoftState::settingUp());
    kept_.clear();
    range_ = { std::numeric_limits<Real>::max(), std::numeric_limits<Real>::lowest() };
    for (const auto& body : *scene.bodies) {
        SoftState* state = body ? softStateOf(*body) : nullptr;
        if (!state) continue;
        auto& picture = kept_[state].picture;
        picture = state->prepared() ? taken(*state, field) : undeformed(static_cast<SoftGrain&>(*body->shape));
        for (const Real value : picture.values)
            range_ = { std::min(range_[0], value), std::max(range_[1], value) };
    }
    if (range_[0] > range_[1]) range_.setZero();
}

} // namespace yade
