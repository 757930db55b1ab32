// Settings for the whole drawing: ambient light, surface and floor.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/panel/colour_button.h"
#include "tool/panel/keys_row.h"
#include "tool/panel/section.h"
#include "tool/panel/value_row.h"

#include <QCheckBox>

namespace lampblack
{

class AmbientSection : public Section
{
    Q_OBJECT

public:
    AmbientSection(SceneDocument& document, QWidget* parent = nullptr);

private:
    void refresh();

    SceneDocument& mDocument;
    ColourButton* mColour;
    ValueRow* mStrength;
};

class SurfaceSection : public Section
{
    Q_OBJECT

public:
    SurfaceSection(SceneDocument& document, QWidget* parent = nullptr);

private:
    void refresh();

    SceneDocument& mDocument;
    ValueRow* mRelief;
    ValueRow* mRoughness;
};

class FloorSection : public Section
{
    Q_OBJECT

public:
    FloorSection(Host& host, SceneDocument& document, QWidget* parent = nullptr);

private:
    void refresh();
    void toggleKey();
    void changeFloor(const QString& text, int gesture, double Floor::*field, double value);

    Host& mHost;
    SceneDocument& mDocument;
    QCheckBox* mOn;
    ValueRow* mPosition;
    ValueRow* mPitch;
    KeysRow* mKeys;
};

} // namespace lampblack
