// How the light is shown: in gradients or in tones, its shade, and the rim.
#pragma once

#include "scene/scene_document.h"
#include "tool/panel/colour_button.h"
#include "tool/panel/section.h"
#include "tool/panel/value_row.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>

#include <functional>

namespace lampblack
{

class LookSection : public Section
{
    Q_OBJECT

public:
    explicit LookSection(SceneDocument& document, QWidget* parent = nullptr);

private:
    QWidget* choices();
    QWidget* toneCount();
    void addMore();
    void addCastShadow(QVBoxLayout& rows);
    void addRim(QVBoxLayout& rows);
    /// A row bound to a value of the look.
    ValueRow* lookRow(const char* name, const QString& label, const QString& hint, double Look::*field);
    ValueRow* rimRow(const char* name, const QString& label, const QString& hint, const SliderScale& scale,
                     double Rim::*field);
    QWidget* colourRow(ColourButton* button, const QString& label);
    void refresh();
    void setToneCount(int count);
    void change(const QString& text, int gesture, const std::function<void(Scene&)>& apply);

    SceneDocument& mDocument;
    QButtonGroup* mChoices;
    QComboBox* mCount;
    QVector<ValueRow*> mTones;
    QVector<std::function<void(const Scene&)>> mShow; ///< what shows the scene in each row
    ValueRow* mSoftness;
    ColourButton* mShade;
    QCheckBox* mRim;
    ColourButton* mRimColour;
};

} // namespace lampblack
