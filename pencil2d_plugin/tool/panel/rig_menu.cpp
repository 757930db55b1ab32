#include "tool/panel/rig_menu.h"

#include "scene/linear_light.h"
#include "scene/rig_file.h"
#include "scene/rig_place.h"
#include "tool/panel/ball_picture.h"

#include <QApplication>
#include <QClipboard>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QMimeData>
#include <QProxyStyle>
#include <QVector3D>

#include <algorithm>

// Resources of a static library must be initialised, and from outside any namespace.
static void initRigs()
{
    Q_INIT_RESOURCE(lampblack_rigs);
}

namespace lampblack
{

namespace
{

constexpr int IconSide = 56;
const QString MimeType = QStringLiteral("application/x-lampblack-rig+json");

class LargeIcons : public QProxyStyle
{
public:
    int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override
    {
        return metric == PM_SmallIconSize ? IconSide : QProxyStyle::pixelMetric(metric, option, widget);
    }
};

/// What falls on a white surface at `place` that faces `normal`: x right, y down, z to the viewer; the
/// canvas's longer side is 2 long and its middle is the origin.
QVector3D lightAtBall(const Rig& rig, const QVector3D& place, const QVector3D& normal)
{
    const double unit = defaultHeight(rig.canvas);
    const auto tint = [](const QColor& colour)
    {
        const LinearColour light = linearColour(colour);
        return QVector3D(float(light[0]), float(light[1]), float(light[2]));
    };
    QVector3D sum = tint(rig.ambient.colour) * float(rig.ambient.strength);
    for (const AreaLight& light : rig.lights)
    {
        if (!light.on)
            continue;
        const QVector3D at(float((light.x - rig.canvas.width / 2.0) / unit),
                           float((light.y - rig.canvas.height / 2.0) / unit), float(light.z / unit));
        const bool isSun = light.kind == LightKind::Sun;
        const QVector3D way = isSun ? at : at - place;
        const float facing = std::max(0.0F, QVector3D::dotProduct(way.normalized(), normal));
        const float fade = isSun ? 1.0F : 1 / std::max(0.05F, way.lengthSquared());
        sum += tint(light.colour) * (float(light.power) * facing * fade);
    }
    return sum;
}

} // namespace

QIcon rigIcon(const Rig& rig, int side, double pixelRatio)
{
    constexpr float Radius = 0.55F; // of the ball on the rig's canvas
    const QVector3D paint(0.75F, 0.75F, 0.75F);
    return QIcon(ballPicture(side, pixelRatio,
                             [&](const QVector3D& normal)
                             {
                                 const QVector3D lit = lightAtBall(rig, normal * Radius, normal) * paint;
                                 const auto encoded = [](float value)
                                 {
                                     return std::min(fromLinear(double(value)), 1.0);
                                 };
                                 return QColor::fromRgbF(encoded(lit.x()), encoded(lit.y()),
                                                         encoded(lit.z()));
                             }));
}

QVector<Rig> presetRigs()
{
    initRigs();
    QVector<Rig> rigs;
    for (const char* name : {"key", "rim", "three-point", "sunset", "moon", "under-light", "lantern"})
    {
        const auto read = readRigFile(QStringLiteral(":/lampblack/rigs/%1.json").arg(QLatin1String(name)));
        if (const Rig* rig = std::get_if<Rig>(&read))
            rigs << *rig;
    }
    return rigs;
}

RigMenu::RigMenu(Host& host, SceneDocument& document, QWidget* parent)
    : QMenu(parent), mHost(host), mDocument(document)
{
    setObjectName(QStringLiteral("lampblack.rigs"));
    setToolTipsVisible(true);
    auto* large = new LargeIcons;
    large->setParent(this);
    setStyle(large);
    addPresets();
    addSeparator();
    addEntry("copy", tr("Copy These Lights"), tr("Copy these lights, to paste them in another project"),
             [this] { copy(); });
    QAction* paste = addEntry("paste", tr("Paste Lights"), tr("Replace these lights by the copied lights"),
                              [this] { this->paste(); });
    addEntry("save", tr("Save These Lights…"), tr("Save these lights in a file, to use them in other shots"),
             [this] { save(); });
    addEntry("load", tr("Load Lights…"), tr("Replace these lights by lights from a file"),
             [this] { load(); });
    connect(this, &QMenu::aboutToShow, this,
            [paste] { paste->setEnabled(QApplication::clipboard()->mimeData()->hasFormat(MimeType)); });
}

void RigMenu::addPresets()
{
    const QVector<Rig> rigs = presetRigs();
    for (const Rig& rig : rigs)
    {
        const QByteArray id = rig.name.toLower().replace(QLatin1Char(' '), QLatin1Char('-')).toUtf8();
        QAction* action = addEntry(id.constData(), rig.name, tr("These lights in place of your own"),
                                   [this, rig] { use(rig, mFigure ? mFigure() : QRectF()); });
        mPresets << Preset{QString::fromUtf8(id), action, rigIcon(rig, IconSide, devicePixelRatioF())};
    }
    setPictures({});
}

void RigMenu::setPictures(const QVector<RigSketch>& sketches)
{
    for (const Preset& preset : qAsConst(mPresets))
    {
        const auto sketch = std::find_if(sketches.begin(), sketches.end(),
                                         [&](const RigSketch& each) { return each.name == preset.name; });
        if (sketch == sketches.end())
        {
            preset.action->setIcon(preset.ball);
            continue;
        }
        QPixmap picture = QPixmap::fromImage(sketch->picture);
        picture.setDevicePixelRatio(double(picture.width()) / IconSide);
        preset.action->setIcon(QIcon(picture));
    }
}

int RigMenu::pictureSide() const
{
    return int(std::lround(IconSide * devicePixelRatioF()));
}

QAction* RigMenu::addEntry(const char* name, const QString& text, const QString& hint,
                           const std::function<void()>& onTriggered)
{
    QAction* action = addAction(text);
    action->setObjectName(QStringLiteral("lampblack.rigs.") + QLatin1String(name));
    action->setToolTip(hint);
    connect(action, &QAction::triggered, this, [onTriggered] { onTriggered(); });
    return action;
}

void RigMenu::use(const Rig& rig, const QRectF& box)
{
    mDocument.edit(tr("Use Lights"), withRig(mDocument.scene(), rig, box));
    mDocument.selectLight(mDocument.scene().lights.isEmpty() ? -1 : 0);
}

void RigMenu::save()
{
    const QString name = QFileInfo(mHost.projectPath()).completeBaseName();
    QString path = QFileDialog::getSaveFileName(
        mHost.window(), tr("Save Lights"),
        (name.isEmpty() ? tr("lights") : name) + QStringLiteral(".rig.json"), tr("Lights (*.json)"));
    if (path.isEmpty())
        return;
    if (QFileInfo(path).suffix().isEmpty())
        path += QStringLiteral(".json");
    if (const auto error = writeRigFile(path, rigOf(mDocument.scene(), QFileInfo(path).baseName())))
        Q_EMIT problem(*error);
}

void RigMenu::load()
{
    const QString path =
        QFileDialog::getOpenFileName(mHost.window(), tr("Load Lights"), QString(), tr("Lights (*.json)"));
    if (path.isEmpty())
        return;
    const auto read = readRigFile(path);
    if (const auto* error = std::get_if<UserError>(&read))
        Q_EMIT problem(*error);
    else
        use(std::get<Rig>(read));
}

void RigMenu::copy() const
{
    auto* copied = new QMimeData;
    const QByteArray text = textOf(rigOf(mDocument.scene(), QString()));
    copied->setData(MimeType, text);
    copied->setText(QString::fromUtf8(text));
    QApplication::clipboard()->setMimeData(copied);
}

void RigMenu::paste()
{
    const auto read = rigFromText(QApplication::clipboard()->mimeData()->data(MimeType), tr("the clipboard"));
    if (const auto* error = std::get_if<UserError>(&read))
        Q_EMIT problem(*error);
    else
        use(std::get<Rig>(read));
}

} // namespace lampblack
