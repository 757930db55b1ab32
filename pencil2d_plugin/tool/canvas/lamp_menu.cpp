#include "tool/canvas/lamp_menu.h"

#include "scene/timeline.h"
#include "tool/canvas/key_input.h"
#include "tool/materials/material_edit.h"

#include <QPainter>
#include <QPixmap>

namespace lampblack
{

namespace
{
constexpr int IconSide = 16;
}

LampMenu::LampMenu(Host& host, SceneDocument& document, QWidget* parent)
    : QMenu(parent), mHost(host), mDocument(document)
{
    setObjectName(QStringLiteral("lampblack.menu"));
}

void LampMenu::openAt(const QPointF& canvas, const QPoint& global, const Handle& handle,
                      const QString& colour)
{
    fillMenu(canvas, handle, colour);
    popup(global);
}

QAction* LampMenu::addEntry(const char* name, const QString& text, const std::function<void()>& onTriggered)
{
    QAction* action = addAction(text);
    action->setObjectName(QStringLiteral("lampblack.menu.") + QLatin1String(name));
    connect(action, &QAction::triggered, this, [onTriggered] { onTriggered(); });
    return action;
}

void LampMenu::fillMenu(const QPointF& canvas, const Handle& handle, const QString& colour)
{
    clear();
    fillLight(canvas, handle.light);
    addSeparator();
    fillFloor(canvas, handle.part == HandlePart::Floor);
    if (!colour.isEmpty())
        fillMaterial(colour);
    addSeparator();
    addEntry("depth", tr("Show Depth: What Is in Front"), [this] { Q_EMIT depthRequested(); });
    addEntry("reset", tr("Reset Lighting"),
             [this] { mDocument.edit(tr("Reset Lighting"), withLightingReset(mDocument.scene())); });
}

void LampMenu::fillLight(const QPointF& canvas, int light)
{
    const QVector<AreaLight>& lights = mDocument.scene().lights;
    QAction* addLight = addEntry("add_light", tr("Add a Light Here"),
                                 [this, canvas]
                                 {
                                     Scene scene = mDocument.scene();
                                     scene.lights << defaultLight(scene.canvas, canvas.x(), canvas.y());
                                     mDocument.edit(tr("Add Light"), scene);
                                     mDocument.selectLight(mDocument.scene().lights.size() - 1);
                                 });
    addLight->setEnabled(lights.size() < MaxLights);
    if (!addLight->isEnabled())
        addLight->setText(tr("Add a Light Here (%1 at most)").arg(MaxLights));
    if (light < 0 || light >= lights.size())
        return;
    addEntry("delete_light", tr("Delete Light %1").arg(light + 1),
             [this, light] { mDocument.edit(tr("Delete Light"), withoutLight(mDocument.scene(), light)); });
    fillKeys<AreaLight>(lights[light],
                        [this, light](const QString& text, const AreaLight& changed)
                        {
                            Scene scene = mDocument.scene();
                            scene.lights[light] = changed;
                            mDocument.edit(text, scene);
                        });
}

void LampMenu::fillFloor(const QPointF& canvas, bool isUnderPointer)
{
    const std::optional<Floor>& floor = mDocument.scene().floor;
    addEntry("floor", floor ? tr("Move the Floor Here") : tr("Put a Floor Here"),
             [this, canvas]
             {
                 Scene scene = mDocument.scene();
                 const int frame = mHost.currentFrame();
                 const Floor before = scene.floor.value_or(Floor());
                 Floor moved = floorAt(before, frame);
                 moved.y = canvas.y();
                 scene.floor = changedAt(before, frame, moved);
                 mDocument.edit(tr("Place Floor"), scene);
             });
    if (!floor)
        return;
    addEntry("remove_floor", tr("Remove the Floor"),
             [this]
             {
                 Scene scene = mDocument.scene();
                 scene.floor.reset();
                 mDocument.edit(tr("Remove Floor"), scene);
             });
    if (!isUnderPointer)
        return;
    fillKeys<Floor>(*floor,
                    [this](const QString& text, const Floor& changed)
                    {
                        Scene scene = mDocument.scene();
                        scene.floor = changed;
                        mDocument.edit(text, scene);
                    });
}

template <class Thing>
void LampMenu::fillKeys(const Thing& thing, const std::function<void(const QString&, const Thing&)>& change)
{
    const int frame = mHost.currentFrame();
    if (keyFrames(thing).contains(frame))
        addEntry("remove_key", tr("Remove Key Here (Frame %1)").arg(frame),
                 [=] { change(tr("Remove Key"), withoutKey(thing, frame)); });
    else
        addEntry("add_key", tr("Add Key Here (Frame %1)").arg(frame),
                 [=] { change(tr("Add Key"), withKey(thing, frame)); })
            ->setEnabled(thing.keys.size() < MaxKeys);
    if (!thing.keys.isEmpty())
        addEntry("remove_keys", tr("Remove All Keys"),
                 [=] { change(tr("Remove All Keys"), withoutKeys(thing, frame)); });
}

void LampMenu::fillMaterial(const QString& colour)
{
    addSeparator();
    QAction* heading = addAction(colourIcon(QColor(colour), IconSide, devicePixelRatioF()), colour);
    heading->setEnabled(false);
    heading->setObjectName(QStringLiteral("lampblack.menu.colour"));
    const Material material = materialOf(mDocument.scene(), colour);
    const auto tick = [this, colour](const char* name, const QString& text, bool on, bool Material::*field)
    {
        QAction* action = addEntry(name, text,
                                   [this, colour, on, field]
                                   {
                                       Material changed = materialOf(mDocument.scene(), colour);
                                       changed.*field = !on;
                                       mDocument.edit(tr("Change Material"),
                                                      withMaterial(mDocument.scene(), colour, changed));
                                   });
        action->setCheckable(true);
        action->setChecked(on);
    };
    tick("diffuse", tr("Diffuse"), material.diffuse, &Material::diffuse);
    tick("glossy", tr("Glossy"), material.glossy, &Material::glossy);
    addEntry("materials", tr("Edit in Materials…"), [this, colour] { Q_EMIT editMaterialRequested(colour); });
}

Scene withLightingReset(Scene scene)
{
    const Scene fresh = defaultScene(sizeOf(scene.canvas));
    scene.lights = fresh.lights;
    scene.ambient = fresh.ambient;
    scene.floor = fresh.floor;
    return scene;
}

QIcon colourIcon(const QColor& colour, int side, double pixelRatio)
{
    QPixmap pixmap((QSizeF(side, side) * pixelRatio).toSize());
    pixmap.setDevicePixelRatio(pixelRatio);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QColor(0, 0, 0, 110));
    painter.setBrush(colour);
    painter.drawRoundedRect(QRectF(0.5, 0.5, side - 1, side - 1), 2, 2);
    painter.end();
    QIcon icon(pixmap);
    icon.addPixmap(pixmap, QIcon::Disabled); // Qt would grey it
    return icon;
}

} // namespace lampblack
