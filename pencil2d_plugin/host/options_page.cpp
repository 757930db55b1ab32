#include "host/options_page.h"

#include <QGridLayout>
#include <QScrollArea>

namespace lampblack
{

OptionsPage::~OptionsPage()
{
    show(false);
    delete mPage;
}

void OptionsPage::setPanel(QWidget* panel)
{
    if (mPage != nullptr || mParts.options == nullptr || mParts.options->widget() == nullptr)
        return;
    auto* scroll = qobject_cast<QScrollArea*>(panel);
    if (scroll == nullptr)
    {
        scroll = new QScrollArea;
        scroll->setFrameShape(QFrame::NoFrame);
        scroll->setWidgetResizable(true);
        scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        scroll->setWidget(panel);
    }
    mPage = scroll;
    mPage->hide();
    QLayout* layout = mParts.options->widget()->layout();
    if (auto* grid = qobject_cast<QGridLayout*>(layout))
        grid->addWidget(mPage, 0, 0);
    else
        layout->addWidget(mPage);
    mPage->setVisible(mShown);
}

void OptionsPage::show(bool panel)
{
    mShown = panel;
    if (mPage == nullptr || mParts.options == nullptr)
        return;
    QWidget* place = mParts.options->widget();
    if (panel)
    {
        const auto others = place->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly);
        for (QWidget* other : others)
        {
            if (other == mPage || other->isHidden())
                continue;
            other->hide();
            mHidden.append(other);
        }
        mPage->show();
        return;
    }
    mPage->hide();
    for (const auto& other : qAsConst(mHidden))
    {
        if (other != nullptr)
            other->show();
    }
    mHidden.clear();
}

} // namespace lampblack
