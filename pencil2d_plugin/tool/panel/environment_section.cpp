#include "tool/panel/environment_section.h"

#include "scene/timeline.h"
#include "tool/materials/material_edit.h"

#include <QHBoxLayout>
#include <QSignalBlocker>

namespace lampblack
{

namespace
{
constexpr double MaxAmbient = 5;

/// From above the canvas to below it.
SliderScale floorScale(double height)
{
    return {-height, 2 * height, height, 0, false, 0};
}

/// A floor near the lower edge, where feet usually are.
Floor firstFloor(const Scene& scene)
{
    Floor floor;
    floor.y = 0.9 * scene.canvas.height;
    return floor;
}

} // namespace

AmbientSection::AmbientSection(SceneDocument& document, QWidget* parent)
    : Section(QStringLiteral("lampblack.panel.ambient_section"), tr("Ambient light"), true, parent),
      mDocument(document)
{
    auto* colourRow = new QHBoxLayout;
    mColour = new ColourButton(QStringLiteral("lampblack.panel.ambient.colour"),
                               tr("Colour of the ambient light"), this);
    colourRow->addWidget(new QLabel(tr("Colour"), this));
    colourRow->addStretch(1);
    colourRow->addWidget(mColour);
    mStrength = new ValueRow(QStringLiteral("lampblack.panel.ambient"), tr("Strength"),
                             {0, MaxAmbient, 2, 2, false, 2}, this);
    mStrength->setHint(tr("Light from all sides. It brightens the shadows. If it is the only light, 1 shows "
                          "the colours as drawn."));
    body()->addLayout(colourRow);
    body()->addWidget(mStrength);
    connect(mColour, &ColourButton::edited, this,
            [this](const QColor& colour, int gesture)
            {
                Scene scene = mDocument.scene();
                scene.ambient.colour = colour;
                mDocument.edit(tr("Change Ambient Colour"), scene, gesture);
            });
    connect(mStrength, &ValueRow::edited, this,
            [this](double value, int gesture)
            {
                Scene scene = mDocument.scene();
                scene.ambient.strength = value;
                mDocument.edit(tr("Change Ambient Light"), scene, gesture);
            });
    connect(&document, &SceneDocument::sceneChanged, this, &AmbientSection::refresh);
    refresh();
}

void AmbientSection::refresh()
{
    mColour->setColour(mDocument.scene().ambient.colour);
    mStrength->setValue(mDocument.scene().ambient.strength);
}

SurfaceSection::SurfaceSection(SceneDocument& document, QWidget* parent)
    : Section(QStringLiteral("lampblack.panel.surface_section"), tr("Surface"), true, parent),
      mDocument(document)
{
    mRelief = new ValueRow(QStringLiteral("lampblack.panel.relief"), tr("Relief"), {0.01, 10, 4, 3, false, 2},
                           this);
    mRelief->setHint(tr("Above 1 everything is rounder, below 1 flatter."));
    mRoughness = new ValueRow(QStringLiteral("lampblack.panel.roughness"), tr("Roughness"),
                              {0.02, 1, 1, 0, false, 2}, this);
    mRoughness->setHint(tr("Width of the highlights on glossy colours: 0.02 is a mirror, 1 is satin. Colours "
                           "with their own roughness do not change."));
    body()->addWidget(mRelief);
    body()->addWidget(mRoughness);
    connect(mRelief, &ValueRow::edited, this,
            [this](double value, int gesture)
            {
                Scene scene = mDocument.scene();
                scene.reliefScale = value;
                mDocument.edit(tr("Change Relief"), scene, gesture);
            });
    connect(mRoughness, &ValueRow::edited, this,
            [this](double value, int gesture)
            { mDocument.edit(tr("Change Roughness"), withRoughness(mDocument.scene(), value), gesture); });
    connect(&document, &SceneDocument::sceneChanged, this, &SurfaceSection::refresh);
    refresh();
}

void SurfaceSection::refresh()
{
    mRelief->setValue(mDocument.scene().reliefScale);
    mRoughness->setValue(mDocument.scene().defaultMaterial.roughness);
}

FloorSection::FloorSection(Host& host, SceneDocument& document, QWidget* parent)
    : Section(QStringLiteral("lampblack.panel.floor_section"), tr("Floor"), true, parent), mHost(host),
      mDocument(document), mOn(new QCheckBox(tr("Catch shadows"), this))
{
    mOn->setObjectName(QStringLiteral("lampblack.panel.floor"));
    mPosition = new ValueRow(QStringLiteral("lampblack.panel.floor.position"), tr("Position"),
                             floorScale(document.scene().canvas.height), this);
    mPosition->setHint(tr("Where the floor meets the paper, from the top edge."));
    mPitch = new ValueRow(QStringLiteral("lampblack.panel.floor.pitch"), tr("Pitch"),
                          {5, 85, 85, 0, false, 0}, this);
    mPitch->setSuffix(QStringLiteral("°"));
    mPitch->setHint(tr("Small: you see the floor from the side. Large: the floor stands up like a wall."));
    body()->addWidget(mOn);
    body()->addWidget(mPosition);
    body()->addWidget(mPitch);
    mKeys = new KeysRow(QStringLiteral("lampblack.panel.floor.keys"), host, this);
    body()->addWidget(mKeys);
    connect(mKeys, &KeysRow::keyToggled, this, &FloorSection::toggleKey);
    connect(&host, &Host::frameChanged, this,
            [this]
            {
                if (isKeyed(mDocument.scene()))
                    refresh();
            });
    connect(mOn, &QCheckBox::clicked, this,
            [this](bool on)
            {
                Scene scene = mDocument.scene();
                scene.floor.reset();
                if (on)
                    scene.floor = firstFloor(scene);
                mDocument.edit(on ? tr("Place Floor") : tr("Remove Floor"), scene);
            });
    connect(mPosition, &ValueRow::edited, this,
            [this](double value, int gesture) { changeFloor(tr("Move Floor"), gesture, &Floor::y, value); });
    connect(mPitch, &ValueRow::edited, this,
            [this](double value, int gesture)
            { changeFloor(tr("Pitch Floor"), gesture, &Floor::pitch, value); });
    connect(&document, &SceneDocument::sceneChanged, this, &FloorSection::refresh);
    refresh();
}

void FloorSection::refresh()
{
    const Scene& scene = mDocument.scene();
    mOn->setChecked(scene.floor.has_value());
    mPosition->setEnabled(scene.floor.has_value());
    mPitch->setEnabled(scene.floor.has_value());
    mPosition->setScale(floorScale(scene.canvas.height));
    mKeys->setEnabled(scene.floor.has_value());
    mKeys->setKeys(scene.floor ? keyFrames(*scene.floor) : QVector<int>());
    const Floor floor = floorAt(scene.floor.value_or(firstFloor(scene)), mHost.currentFrame());
    mPosition->setValue(floor.y);
    mPitch->setValue(floor.pitch);
}

void FloorSection::changeFloor(const QString& text, int gesture, double Floor::*field, double value)
{
    Scene scene = mDocument.scene();
    if (!scene.floor)
        return;
    const int frame = mHost.currentFrame();
    Floor shown = floorAt(*scene.floor, frame);
    shown.*field = value;
    scene.floor = changedAt(*scene.floor, frame, shown);
    mDocument.edit(text, scene, gesture);
}

void FloorSection::toggleKey()
{
    Scene scene = mDocument.scene();
    if (!scene.floor)
        return;
    const int frame = mHost.currentFrame();
    const bool has = keyFrames(*scene.floor).contains(frame);
    scene.floor = has ? withoutKey(*scene.floor, frame) : withKey(*scene.floor, frame);
    mDocument.edit(has ? tr("Remove Key") : tr("Add Key"), scene);
}

} // namespace lampblack
