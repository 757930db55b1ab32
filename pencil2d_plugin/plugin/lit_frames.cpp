#include "plugin/lit_frames.h"

#include "protocol/generated/apart_layers.h"
#include "scene/layer_roles.h"

#include <QFileInfo>

#include <algorithm>

namespace lampblack
{

namespace
{
constexpr int NewsMs = 100;
constexpr int WarningMs = 10000;

/// What shows in the lit frames: not what the plugin itself notes in a scene, such as the role of its layer.
Scene shownOf(Scene scene)
{
    scene.extra = {};
    return scene;
}

} // namespace

LitFrames::LitFrames(Host& host, FrameFeed& feed, const LitLayer& layer, SceneDocument& document,
                     std::function<QString(int)> pathOf, QObject* parent)
    : QObject(parent), mHost(host), mLayer(layer), mDocument(document), mPathOf(std::move(pathOf))
{
    mNews.setSingleShot(true);
    mNews.setInterval(NewsMs);
    connect(&mNews, &QTimer::timeout, this, &LitFrames::changed);
    connect(&document, &SceneDocument::sceneChanged, &mNews, qOverload<>(&QTimer::start));
    connect(&host, &Host::projectOpened, this,
            [this]
            {
                mFrames.clear();
                mNews.start();
            });
    connect(&host, &Host::layersChanged, this, &LitFrames::findFrames);
    connect(&host, &Host::drawingChanged, this, &LitFrames::warnOfHiddenDrawing);
    connect(&host, &Host::toolActivated, this,
            [this](bool active)
            {
                if (!active)
                    warnOfHiddenDrawing();
            });
    connect(&feed, &FrameFeed::frameRedrawn, this, [this](int frame) { setRedrawn(frame, true); });
    connect(&feed, &FrameFeed::frameSame, this, [this](int frame) { setRedrawn(frame, false); });
}

void LitFrames::setLit(const QSet<int>& frames, const Scene& scene)
{
    const auto shared = std::make_shared<const Scene>(shownOf(scene));
    for (const int frame : frames)
        mFrames.insert(frame, {shared, false});
    mNews.start();
}

int LitFrames::total() const
{
    return mLayer.exists() ? mFrames.size() : 0;
}

QVector<int> LitFrames::outdated() const
{
    QVector<int> frames;
    if (!mLayer.exists())
        return frames;
    const Scene now = shownOf(mDocument.scene());
    const Scene* same = nullptr; // most frames share theirs
    for (auto lit = mFrames.begin(); lit != mFrames.end(); ++lit)
    {
        if (lit->scene.get() != same && *lit->scene == now)
            same = lit->scene.get();
        if (lit->isRedrawn || lit->scene.get() != same)
            frames.append(lit.key());
    }
    return frames;
}

void LitFrames::findFrames()
{
    mNews.start();
    if (!mFrames.isEmpty() || !mLayer.exists())
        return;
    QSet<int> frames;
    for (int frame = 1; frame <= mHost.frameCount(); ++frame)
    {
        if (QFileInfo::exists(mPathOf(frame)))
            frames.insert(frame);
    }
    setLit(frames, mDocument.scene());
}

void LitFrames::setRedrawn(int frame, bool redrawn)
{
    const auto lit = mFrames.find(frame);
    if (lit == mFrames.end() || lit->isRedrawn == redrawn)
        return;
    lit->isRedrawn = redrawn;
    mNews.start();
}

void LitFrames::warnOfHiddenDrawing()
{
    if (!mFrames.contains(mHost.currentFrame()) || !mLayer.exists())
        return;
    const QStringList opaque{resultLayer(), resultLayer(QLatin1String(protocol::ApartLayers.front()))};
    const QVector<Layer> layers = mHost.layers();
    const auto hiding =
        std::find_if(layers.begin(), layers.end(),
                     [&](const Layer& layer) { return layer.visible && opaque.contains(layer.name); });
    if (hiding != layers.end() && !isResult(mHost.currentLayer(), mDocument.layerRoles()))
        mHost.showStatus(tr("The layer \"%1\" hides what you draw here. Hide it, or render what changed when "
                            "you are done.")
                             .arg(hiding->name),
                         WarningMs);
}

} // namespace lampblack
