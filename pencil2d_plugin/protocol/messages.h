// Every message, as SPEC 8 has them; ranges are checked by the decoder and owed by who encodes.
//
// Requests and revisions rise within a session; frames are numbered as the drawing program counts;
// crops are view pixels, x right, y down, from the frame's top left corner.
#pragma once

#include "protocol/planes.h"
#include "scene/scene.h"

#include <QRectF>
#include <QStringList>
#include <QTransform>

#include <variant>

namespace lampblack::protocol
{

constexpr int Major = 1;
constexpr int Minor = 0;

enum class Sender
{
    Client,
    Worker
};

enum class Show
{
    Lit, ///< in image only: preview asks for it, view does not
    Normals,
    Relief
};

enum class ChildState
{
    Off,
    Starting,
    Idle,
    Working,
    Restarting
};

enum class Outcome
{
    Finished,
    Cancelled,
    Failed
};

// From the client

struct Hello
{
    int minor = Minor;
    QString client;
    QString clientVersion;
    QStringList capabilities;
};

/// Frame `frame` shows the drawing `digest`; its planes come along or were sent before.
struct PutFrame
{
    int frame = 0;
    QByteArray digest;
    QTransform camera; ///< canvas to view, affine
    QVector<Plane> planes;
};

struct DropFrame
{
    int frame = 0;
};

struct SetScene
{
    quint64 revision = 1;
    Scene scene;
};

/// Look at a frame, lit; `width` x `height` device pixels are wanted of the crop.
struct Preview
{
    quint64 request = 1;
    int frame = 0;
    QRectF crop;
    int width = 1;
    int height = 1;
};

/// Look at a frame's normals or relief.
struct View
{
    quint64 request = 1;
    int frame = 0;
    Show show = Show::Normals;
    QRectF crop;
    int width = 1;
    int height = 1;
};

struct GetPalette
{
    quint64 request = 1;
    int frame = 0;
};

/// Light frames ("1-20x2,25") into files ("/shots/a.%04d.png").
struct Render
{
    quint64 request = 1;
    QString frames;
    QString output;
    Quality quality = Quality::Final;
    bool keepFinished = false;
};

struct Cancel
{
    quint64 request = 1;
};

// From the worker

struct Welcome
{
    int minor = Minor;
    QString session;
    QString workerVersion;
    QStringList capabilities;
    int statusMs = 1000;
};

struct NeedFrame
{
    int frame = 0;
    QByteArray digest;
};

/// A picture of a look; its plane is the message's only one.
struct Image
{
    quint64 request = 1;
    int frame = 0;
    QByteArray digest;
    quint64 revision = 0; ///< 0: no scene was set
    Show show = Show::Lit;
    quint64 pass = 0;
    quint64 spp = 0;
    bool converged = false;
    QRectF crop;
    QVector<Plane> planes;
};

struct Swatch
{
    QString colour; ///< "#rrggbb"
    quint64 pixels = 0;
};

struct Palette
{
    quint64 request = 1;
    int frame = 0;
    QByteArray digest;
    QVector<Swatch> swatches;
};

struct Progress
{
    quint64 request = 1;
    int frame = 0;
    double share = 0; ///< of that frame, 0 to 1
    quint64 framesDone = 0;
    quint64 framesTotal = 0;
};

struct FrameDone
{
    quint64 request = 1;
    int frame = 0;
    QString path;
    bool kept = false;
};

struct Done
{
    quint64 request = 1;
    Outcome outcome = Outcome::Finished;
    quint64 framesDone = 0;
    quint64 framesTotal = 0;
    quint64 framesFailed = 0;
};

struct Status
{
    quint64 uptimeMs = 0;
    quint64 revision = 0;
    ChildState preview = ChildState::Idle;
    ChildState job = ChildState::Idle;
    quint64 jobsWaiting = 0;
    quint64 framesHeld = 0;
    quint64 framesLit = 0;
    quint64 memoryBytes = 0;
};

struct Error
{
    QString code; ///< see ERRORS.md; an unknown one is shown like any other
    QString what;
    QString remedy;
    QString details;
    bool fatal = false;
    QString about; ///< type of the message it answers
    std::optional<quint64> request;
    std::optional<int> frame;
};

// From either side

struct Bye
{
    QString reason;
};

using Message =
    std::variant<Hello, PutFrame, DropFrame, SetScene, Preview, View, GetPalette, Render, Cancel, Welcome,
                 NeedFrame, Image, Palette, Progress, FrameDone, Done, Status, Error, Bye>;

/// The message's name on the wire, such as "put_frame".
QString typeOf(const Message& message);

} // namespace lampblack::protocol
