#include "tool/materials/swatch_row.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>

namespace lampblack
{

namespace
{
constexpr int SwatchSide = 22;
}

SwatchRow::SwatchRow(const QString& colour, int columnWidth, QWidget* parent)
    : QWidget(parent), mColour(colour), mSwatch(new QWidget(this)), mDiffuse(new QCheckBox(this)),
      mGlossy(new QCheckBox(this))
{
    setObjectName(QStringLiteral("lampblack.materials.row.") + colour);
    mSwatch->setFixedSize(SwatchSide, SwatchSide);
    auto* name = new QLabel(colour, this);
    mDiffuse->setObjectName(QStringLiteral("lampblack.materials.diffuse.") + colour);
    mDiffuse->setAccessibleName(tr("%1 diffuse").arg(colour));
    mDiffuse->setToolTip(tr("Diffuse: matt, takes light and shade"));
    mGlossy->setObjectName(QStringLiteral("lampblack.materials.glossy.") + colour);
    mGlossy->setAccessibleName(tr("%1 glossy").arg(colour));
    mGlossy->setToolTip(tr("Glossy: shows highlights"));
    name->setMinimumWidth(name->fontMetrics().horizontalAdvance(colour.left(4)));
    auto* row = new QHBoxLayout;
    row->setSpacing(6);
    row->addWidget(mSwatch);
    row->addWidget(name, 1);
    for (QCheckBox* box : {mDiffuse, mGlossy})
    {
        auto* cell = new QWidget(this);
        cell->setFixedWidth(columnWidth);
        auto* centred = new QHBoxLayout(cell);
        centred->setContentsMargins(0, 0, 0, 0);
        centred->addWidget(box, 0, Qt::AlignCenter);
        row->addWidget(cell);
    }
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(6, 2, 2, 2);
    column->setSpacing(3);
    column->addLayout(row);
    const auto tick = [this](bool Material::*field, bool on)
    {
        Material material = mMaterial;
        material.*field = on;
        Q_EMIT edited(mColour, material, 0);
    };
    connect(mDiffuse, &QCheckBox::clicked, this, [tick](bool on) { tick(&Material::diffuse, on); });
    connect(mGlossy, &QCheckBox::clicked, this, [tick](bool on) { tick(&Material::glossy, on); });
    setMaterial(Material());
}

void SwatchRow::setMaterial(const Material& material)
{
    mMaterial = material;
    mDiffuse->setChecked(material.diffuse);
    mGlossy->setChecked(material.glossy);
    if (material.glossy && mGloss == nullptr)
        buildGloss();
    if (mGloss == nullptr)
        return;
    mGloss->setVisible(material.glossy);
    mRoughness->setVisible(material.glossy);
    mGloss->setValue(material.gloss);
    mRoughness->setValue(material.roughness);
}

void SwatchRow::buildGloss()
{
    mGloss = new ValueRow(QStringLiteral("lampblack.materials.gloss.") + mColour, tr("Gloss"),
                          {0, 1, 1, 0, false, 2}, this);
    mGloss->setHint(tr("How strong the highlights are"));
    mRoughness = new ValueRow(QStringLiteral("lampblack.materials.roughness.") + mColour, tr("Roughness"),
                              {0.02, 1, 1, 0, false, 2}, this);
    mRoughness->setHint(tr("How wide the highlights are: 0.02 is a mirror, 1 is satin"));
    for (ValueRow* value : {mGloss, mRoughness})
    {
        value->layout()->setContentsMargins(SwatchSide + 6, 0, 4, 0);
        layout()->addWidget(value);
    }
    const auto change = [this](double Material::*field, double value, int gesture)
    {
        Material material = mMaterial;
        material.*field = value;
        Q_EMIT edited(mColour, material, gesture);
    };
    connect(mGloss, &ValueRow::edited, this,
            [change](double value, int gesture) { change(&Material::gloss, value, gesture); });
    connect(mRoughness, &ValueRow::edited, this,
            [change](double value, int gesture) { change(&Material::roughness, value, gesture); });
}

void SwatchRow::setHighlighted(bool highlighted)
{
    if (highlighted == mHighlighted)
        return;
    mHighlighted = highlighted;
    update();
}

void SwatchRow::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    if (mHighlighted)
    {
        QColor band = palette().color(QPalette::Highlight);
        painter.setPen(band);
        band.setAlpha(60);
        painter.setBrush(band);
        painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 3, 3);
    }
    painter.setPen(QColor(0, 0, 0, 110));
    painter.setBrush(QColor(mColour));
    painter.drawRoundedRect(QRectF(mSwatch->geometry()).adjusted(0.5, 0.5, -0.5, -0.5), 2, 2);
}

} // namespace lampblack
