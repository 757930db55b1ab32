// The fields of every message and their ranges (SPEC 8), once for reading and for writing.
#pragma once

#include "protocol/messages.h"
#include "scene/json_reader.h"
#include "scene/json_text.h"

namespace lampblack::protocol
{

constexpr double MaxFrame = 999999;
constexpr double MaxInt32 = 2147483647;
constexpr double MaxImageSide = 4096;

constexpr std::array<Choice<Role>, 4> Roles = {
    {{"pixels", Role::Pixels}, {"mask", Role::Mask}, {"ink", Role::Ink}, {"picture", Role::Picture}}};
constexpr std::array<Choice<Format>, 3> Formats = {
    {{"rgba8", Format::Rgba8}, {"rgba8_premultiplied", Format::Rgba8Premultiplied}, {"a8", Format::A8}}};
constexpr std::array<Choice<Show>, 2> ViewShows = {{{"normals", Show::Normals}, {"relief", Show::Relief}}};
constexpr std::array<Choice<Show>, 3> ImageShows = {
    {{"lit", Show::Lit}, {"normals", Show::Normals}, {"relief", Show::Relief}}};
constexpr std::array<Choice<Quality>, 3> Qualities = {
    {{"low", Quality::Low}, {"medium", Quality::Medium}, {"final", Quality::Final}}};
constexpr std::array<Choice<Outcome>, 3> Outcomes = {
    {{"finished", Outcome::Finished}, {"cancelled", Outcome::Cancelled}, {"failed", Outcome::Failed}}};
constexpr std::array<Choice<ChildState>, 5> ChildStates = {{{"off", ChildState::Off},
                                                            {"starting", ChildState::Starting},
                                                            {"idle", ChildState::Idle},
                                                            {"working", ChildState::Working},
                                                            {"restarting", ChildState::Restarting}}};

/// A named regular expression, compiled once.
struct Patterns
{
    QRegularExpression digest{QStringLiteral("^[0-9a-f]{40}$(?!\\n)")};
    QRegularExpression session{QStringLiteral("^[0-9a-f]{32}$(?!\\n)")};
    QRegularExpression colour{QStringLiteral("^#[0-9a-f]{6}$(?!\\n)")};
    QRegularExpression capability{QStringLiteral("^[a-z0-9_]+$(?!\\n)")};
    QRegularExpression errorCode{QStringLiteral("^[a-z][a-z0-9_]*$(?!\\n)")};
    QRegularExpression output{QStringLiteral("^/[^%\\x00-\\x1f\\x7f]*%0[1-9]d\\.png$(?!\\n)")};
    QRegularExpression frames{QStringLiteral("^[0-9]{1,6}(-[0-9]{1,6}(x[0-9]{1,6})?)?"
                                             "(,[0-9]{1,6}(-[0-9]{1,6}(x[0-9]{1,6})?)?)*$(?!\\n)")};
};

const Patterns& patterns();

template <class Fields> void request(Fields& fields, quint64& value)
{
    fields.integer("request", value, 1, MaxNumber);
}

template <class Fields> void frame(Fields& fields, int& value)
{
    fields.integer("frame", value, 0, MaxFrame);
}

template <class Fields>
void count(Fields& fields, const char* name, quint64& value, Need need = Need::Required)
{
    fields.integer(name, value, 0, MaxNumber, need);
}

template <class Fields> void digest(Fields& fields, QByteArray& value)
{
    QString text = QString::fromLatin1(value);
    fields.text("digest", text, 40, 40, patterns().digest);
    value = text.toLatin1();
}

template <class Fields> void capabilities(Fields& fields, QStringList& values)
{
    fields.texts("capabilities", values, 32, 32, patterns().capability);
}

struct Crop
{
    double x = 0;
    double y = 0;
    double width = 1;
    double height = 1;
};

template <class Fields> void describe(Fields& fields, Crop& crop)
{
    constexpr double Far = 1e5;
    fields.real("x", crop.x, -Far, Far);
    fields.real("y", crop.y, -Far, Far);
    fields.real("width", crop.width, 0.01, Far);
    fields.real("height", crop.height, 0.01, Far);
}

template <class Fields> void crop(Fields& fields, QRectF& value)
{
    Crop crop = {value.x(), value.y(), value.width(), value.height()};
    fields.object("crop", crop);
    value = QRectF(crop.x, crop.y, crop.width, crop.height);
}

template <class Fields, class Look> void wantedSize(Fields& fields, Look& look)
{
    fields.integer("width", look.width, 1, MaxImageSide);
    fields.integer("height", look.height, 1, MaxImageSide);
}

template <class Fields> void describe(Fields& fields, Plane& plane)
{
    fields.choice("role", plane.role, Roles);
    fields.choice("format", plane.format, Formats);
    fields.integer("width", plane.width, 1, MaxInt32);
    fields.integer("height", plane.height, 1, MaxInt32);
    fields.integer("stride", plane.stride, 1, MaxInt32);
}

template <class Fields> void describe(Fields& fields, Hello& hello)
{
    fields.integer("minor", hello.minor, 0, 999);
    fields.text("client", hello.client, 1, 64);
    fields.text("client_version", hello.clientVersion, 1, 64);
    capabilities(fields, hello.capabilities);
}

template <class Fields> void describe(Fields& fields, PutFrame& put)
{
    const QTransform& t = put.camera;
    std::array<double, 6> camera = {t.m11(), t.m21(), t.dx(), t.m12(), t.m22(), t.dy()};
    frame(fields, put.frame);
    digest(fields, put.digest);
    fields.reals("camera", camera, -1e6, 1e6);
    fields.list("planes", put.planes, 3, Need::Optional);
    put.camera = QTransform(camera[0], camera[3], camera[1], camera[4], camera[2], camera[5]);
}

template <class Fields> void describe(Fields& fields, DropFrame& drop)
{
    frame(fields, drop.frame);
}

template <class Fields> void describe(Fields& fields, SetScene& set)
{
    fields.scene("scene", set.scene);
    fields.integer("revision", set.revision, 1, MaxNumber);
}

template <class Fields> void describe(Fields& fields, Preview& preview)
{
    request(fields, preview.request);
    frame(fields, preview.frame);
    crop(fields, preview.crop);
    wantedSize(fields, preview);
}

template <class Fields> void describe(Fields& fields, View& view)
{
    request(fields, view.request);
    frame(fields, view.frame);
    fields.choice("show", view.show, ViewShows);
    crop(fields, view.crop);
    wantedSize(fields, view);
}

template <class Fields> void describe(Fields& fields, GetPalette& get)
{
    request(fields, get.request);
    frame(fields, get.frame);
}

template <class Fields> void describe(Fields& fields, Render& render)
{
    request(fields, render.request);
    fields.text("frames", render.frames, 0, 1024, patterns().frames);
    fields.text("output", render.output, 0, 1024, patterns().output);
    fields.choice("quality", render.quality, Qualities, Need::Optional);
    fields.boolean("keep_finished", render.keepFinished, Need::Optional);
}

template <class Fields> void describe(Fields& fields, Cancel& cancel)
{
    request(fields, cancel.request);
}

template <class Fields> void describe(Fields& fields, Welcome& welcome)
{
    fields.integer("minor", welcome.minor, 0, 999);
    fields.text("session", welcome.session, 0, 32, patterns().session);
    fields.text("worker_version", welcome.workerVersion, 1, 64);
    capabilities(fields, welcome.capabilities);
    fields.integer("status_ms", welcome.statusMs, 100, 10000, Need::Optional);
}

template <class Fields> void describe(Fields& fields, NeedFrame& need)
{
    frame(fields, need.frame);
    digest(fields, need.digest);
}

template <class Fields> void describe(Fields& fields, Image& image)
{
    request(fields, image.request);
    frame(fields, image.frame);
    digest(fields, image.digest);
    count(fields, "revision", image.revision);
    fields.choice("show", image.show, ImageShows);
    count(fields, "pass", image.pass);
    count(fields, "spp", image.spp);
    fields.boolean("converged", image.converged);
    crop(fields, image.crop);
    fields.list("planes", image.planes, 1, Need::Optional);
}

template <class Fields> void describe(Fields& fields, Swatch& swatch)
{
    fields.text("colour", swatch.colour, 0, 7, patterns().colour);
    count(fields, "pixels", swatch.pixels);
}

template <class Fields> void describe(Fields& fields, Palette& palette)
{
    request(fields, palette.request);
    frame(fields, palette.frame);
    digest(fields, palette.digest);
    fields.list("swatches", palette.swatches, 256, Need::Required);
}

template <class Fields> void describe(Fields& fields, Progress& progress)
{
    request(fields, progress.request);
    frame(fields, progress.frame);
    fields.real("share", progress.share, 0, 1);
    count(fields, "frames_done", progress.framesDone);
    count(fields, "frames_total", progress.framesTotal);
}

template <class Fields> void describe(Fields& fields, FrameDone& done)
{
    request(fields, done.request);
    frame(fields, done.frame);
    fields.text("path", done.path, 1, 1024);
    fields.boolean("kept", done.kept, Need::Optional);
}

template <class Fields> void describe(Fields& fields, Done& done)
{
    request(fields, done.request);
    fields.choice("outcome", done.outcome, Outcomes);
    count(fields, "frames_done", done.framesDone);
    count(fields, "frames_total", done.framesTotal);
    count(fields, "frames_failed", done.framesFailed, Need::Optional);
}

template <class Fields> void describe(Fields& fields, Status& status)
{
    count(fields, "uptime_ms", status.uptimeMs);
    count(fields, "revision", status.revision);
    fields.choice("preview", status.preview, ChildStates);
    fields.choice("job", status.job, ChildStates);
    count(fields, "jobs_waiting", status.jobsWaiting, Need::Optional);
    count(fields, "frames_held", status.framesHeld, Need::Optional);
    count(fields, "frames_lit", status.framesLit, Need::Optional);
    count(fields, "memory_bytes", status.memoryBytes, Need::Optional);
}

template <class Fields> void describe(Fields& fields, Error& error)
{
    fields.text("code", error.code, 0, 40, patterns().errorCode);
    fields.text("what", error.what, 0, 500);
    fields.text("remedy", error.remedy, 0, 500, Need::Optional);
    fields.text("details", error.details, 0, 4000, Need::Optional);
    fields.boolean("fatal", error.fatal, Need::Optional);
    fields.text("about", error.about, 0, 40, Need::Optional);
    fields.integer("request", error.request, 1, MaxNumber);
    fields.integer("frame", error.frame, 0, MaxFrame);
}

template <class Fields> void describe(Fields& fields, Bye& bye)
{
    fields.text("reason", bye.reason, 0, 500, Need::Optional);
}

} // namespace lampblack::protocol
